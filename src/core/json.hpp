#pragma once

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
double rounded(double x);

/// The same as JSON; null for nothing.
Json rounded_or_null(const std::optional<double>& x);

/// Text of a JSON file: indented, with a line feed at its end. A number that is not finite is
/// written as null, and bytes that are no UTF-8 are replaced.
std::string to_text(const Json& json);

}  // namespace twin
