#include "config/read_text.hpp"

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

}  // namespace twin::config
