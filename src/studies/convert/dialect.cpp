#include "studies/convert/dialect.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "studies/convert/bspline.hpp"
#include "studies/convert/knot_nurbs.hpp"
#include "studies/convert/uniform_nurbs.hpp"

namespace twin::studies::convert {
namespace {

using Make = std::unique_ptr<Dialect> (*)();

struct Entry {
  std::string_view name;
  Make make;
  bool is_readable;
};

constexpr std::array<Entry, 4> kDialects = {{
    {"g5.2", []() -> std::unique_ptr<Dialect> { return std::make_unique<UniformNurbs>(); }, true},
    {"g6.2", []() -> std::unique_ptr<Dialect> { return std::make_unique<KnotNurbs>(); }, true},
    {"fanuc", []() -> std::unique_ptr<Dialect> { return std::make_unique<FanucNurbs>(); }, true},
    {"bspline", []() -> std::unique_ptr<Dialect> { return std::make_unique<Bspline>(); }, false},
}};

}  // namespace

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

std::vector<std::string> dialect_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kDialects) {
    names.emplace_back(entry.name);
  }
  return names;
}

bool is_readable(std::string_view name) {
  for (const Entry& entry : kDialects) {
    if (entry.name == name) {
      return entry.is_readable;
    }
  }
  return false;
}

std::unique_ptr<Dialect> make_dialect(std::string_view name) {
  for (const Entry& entry : kDialects) {
    if (entry.name == name) {
      return entry.make();
    }
  }
  return nullptr;
}

std::string number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
      text.pop_back();
    }
  }
  return text == "-0" ? "0" : text;
}

double rounded(double value, int decimals) {
  return std::strtod(number(value, decimals).c_str(), nullptr);
}

}  // namespace twin::studies::convert
