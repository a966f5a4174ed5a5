#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace twin {

/// SHA-256 of some bytes [FIPS 180-4], as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// SHA-256 of a file of any size; empty when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace twin
