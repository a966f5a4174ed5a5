#include "config/toml_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace twin::config {
namespace {

constexpr std::uintmax_t kLargest = 16U << 20U;  // [bytes]

tl::unexpected<Error> about(const std::filesystem::path& file, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kFile, std::move(message), file.string(), 0, 0});
}

}  // namespace

Expected<std::string> read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    return about(file, "is a directory, not a file");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return about(file, std::string("cannot be read: ") + std::strerror(errno));
  }
  std::string text;
  for (char block[4096]; stream.read(block, sizeof block) || stream.gcount() > 0;) {
    text.append(block, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargest) {
      return about(file, "is larger than 16 MB; this is no settings file");
    }
  }
  if (stream.bad()) {
    return about(file, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (text.find('\0') != std::string::npos) {
    return about(file, "holds binary data; this is no settings file");
  }
  return text;
}

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
