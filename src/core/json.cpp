#include "core/json.hpp"

namespace twin {
namespace {

std::string written(const Json& json, int indent, bool is_ascii) {
  return json.dump(indent, ' ', is_ascii, Json::error_handler_t::replace);
}

}  // namespace

Json parse_json(std::string_view text) { return Json::parse(text, nullptr, false); }

std::size_t json_error(std::string_view text) {
  try {
    [[maybe_unused]] const Json value = Json::parse(text);
  } catch (const Json::parse_error& error) {
    return error.byte;
  }
  return 0;
}

std::string to_text(const Json& json) { return written(json, 2, false) + "\n"; }

std::string to_line(const Json& json) { return written(json, -1, false); }

std::string to_ascii_line(const Json& json) { return written(json, -1, true); }

std::string inside_html(const Json& json) {
  std::string text = to_line(json);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

}  // namespace twin
