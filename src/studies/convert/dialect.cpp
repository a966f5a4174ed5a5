#include "studies/convert/dialect.hpp"

#include <fmt/format.h>

#include <utility>

#include "studies/convert/coordinate_text.hpp"

namespace twin::studies::convert {

std::string Dialect::comment(std::string_view text) const { return fmt::format("({})", text); }

std::string Dialect::path_mode(gcode::PathMode mode, double tolerance) const {
  if (mode == gcode::PathMode::kExactStop) {
    return "G61";
  }
  return tolerance > 0.0 ? fmt::format("G64 P{}", number(tolerance, 6)) : "G64";
}

std::string Dialect::dwell(double duration) const {
  return fmt::format("G04 P{}", number(duration, 6));
}

tl::unexpected<Error> refuse_curve(const CurveRequest& request, std::string message) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kProgram, std::move(message), {}, static_cast<int>(request.line), 0});
}

}  // namespace twin::studies::convert
