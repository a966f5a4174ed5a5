#include "core/json.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace twin {

double rounded(double x) { return std::strtod(fmt::format("{:.9g}", x).c_str(), nullptr); }

Json rounded_or_null(const std::optional<double>& x) {
  return x ? Json(rounded(*x)) : Json(nullptr);
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace twin
