#pragma once

#include <nettle/sha2.h>

#include <string>
#include <string_view>

namespace twin {

/// SHA-256 of bytes that come one piece after the other [FIPS 180-4].
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// The digest of all bytes added, as 64 lower-case hexadecimal digits; then it begins anew.
  std::string finish();

 private:
  sha256_ctx context_;
};

/// SHA-256 of some bytes, as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace twin
