#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

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

// What takes long to compile is in one source.

/// The JSON value that a text is; a value with is_discarded() when it is none.
Json parse_json(std::string_view text);

/// Where a text stops being JSON [byte, from 1]; 0 when it is JSON.
std::size_t json_error(std::string_view text);

/// Text of a JSON file: indented, with a line feed at its end. A number that is not finite is
/// written as null, and bytes that are no UTF-8 are replaced.
std::string to_text(const Json& json);

/// The same on one line, without a line feed.
std::string to_line(const Json& json);

/// The same on one line of ASCII alone: other characters are escapes.
std::string to_ascii_line(const Json& json);

/// JSON on one line as the content of an HTML element: every "<" is written as an escape, so that
/// nothing in it ends the element.
std::string inside_html(const Json& json);

}  // namespace twin
