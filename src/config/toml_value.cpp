#include "config/toml_value.hpp"

#include <fmt/format.h>

namespace twin::config {

Expected<toml::table> parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& e) {
    const auto place = e.source().begin;
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "not valid TOML: " + std::string(e.description()), file,
              static_cast<int>(place.line), static_cast<int>(place.column)});
  }
}

Expected<Value> value_of(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) {
    return Value{flag->get()};
  }
  if (const auto* whole = node.as_integer()) {
    return Value{whole->get()};
  }
  if (const auto* real = node.as_floating_point()) {
    return Value{real->get()};
  }
  if (const auto* text = node.as_string()) {
    return Value{text->get()};
  }
  std::vector<double> list;
  if (const auto* array = node.as_array()) {
    for (const toml::node& element : *array) {
      if (!element.is_number()) {
        return fail(ErrorCode::kFile, "a list may hold numbers only");
      }
      list.push_back(element.value<double>().value_or(0.0));
    }
    return Value{std::move(list)};
  }
  return fail(ErrorCode::kFile, "neither a number, a text nor a list of numbers");
}

}  // namespace twin::config
