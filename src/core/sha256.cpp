#include "core/sha256.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <fstream>

namespace twin {
namespace {

void add(sha256_ctx& context, std::string_view bytes) {
  // The library hashes unsigned bytes; a char may be read as one.
  sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

std::string finish(sha256_ctx& context) {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

}  // namespace

std::string sha256(std::string_view bytes) {
  sha256_ctx context;
  sha256_init(&context);
  add(context, bytes);
  return finish(context);
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return "";
  }
  sha256_ctx context;
  sha256_init(&context);
  std::array<char, 65536> bytes{};
  while (in.read(bytes.data(), bytes.size()) || in.gcount() > 0) {
    add(context, {bytes.data(), static_cast<std::size_t>(in.gcount())});
  }
  return in.bad() ? "" : finish(context);
}

}  // namespace twin
