#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace twin {

/// JSON whose keys keep the order in which they were added.
using Json = nlohmann::ordered_json;

/// The double nearest to x written with nine significant digits, as every JSON file of results
/// holds it: picometres in a path of metres, and no 0.30000000000000004.
///
/// What is not finite stays so; to_text() writes it as null.
inline double rounded(double x) { return std::strtod(fmt::format("{:.9g}", x).c_str(), nullptr); }

/// The same as JSON; null for nothing.
inline Json rounded_or_null(const std::optional<double>& x) {
  return x ? Json(rounded(*x)) : Json(nullptr);
}

/// A text of an object, or null where the JSON is no object or has no text of this name.
inline const std::string* text_in(const Json& json, const char* key) {
  const auto member = json.is_object() ? json.find(key) : json.end();
  return member != json.end() && member->is_string() ? member->get_ptr<const std::string*>()
                                                     : nullptr;
}

/// The same of a number.
inline std::optional<double> number_in(const Json& json, const char* key) {
  const auto member = json.is_object() ? json.find(key) : json.end();
  return member != json.end() && member->is_number() ? std::optional(member->get<double>())
                                                     : std::nullopt;
}

/// Text of a JSON file: indented, with a line feed at its end. A number that is not finite is
/// written as null, and bytes that are no UTF-8 are replaced.
inline std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// JSON on one line as the content of an HTML element: every "<" is written as an escape, so that
/// nothing in it ends the element.
inline std::string inside_html(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

}  // namespace twin
