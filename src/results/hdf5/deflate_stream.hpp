#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace twin::results::hdf5 {

struct HuffmanCode;

/// Blocks of deflate (RFC 1951) without matches, none of which is the stream's last one: bytes as
/// they are, or by a Huffman code of their own.
class DeflateStream {
 public:
  /// @param packed  what is appended to
  explicit DeflateStream(std::vector<std::uint8_t>& packed) : packed_(packed) {}

  /// Bytes as they are (3.2.4). @param bytes  at most 65535
  void put_stored(std::span<const std::uint8_t> bytes);
  /// Bytes by the best code for them (3.2.7).
  void put_coded(std::span<const std::uint8_t> bytes);
  /// Ends at a whole byte, behind which another stream of deflate can go on.
  void align();

 private:
  void put(std::uint64_t bits, unsigned count);
  void put_header(std::span<const std::uint8_t> lengths);
  void put_symbols(std::span<const std::uint8_t> bytes, const HuffmanCode& code);

  std::vector<std::uint8_t>& packed_;
  std::uint64_t waiting_ = 0;  // bits that are no whole byte yet, the first one lowest
  unsigned count_ = 0;         // of them
};

}  // namespace twin::results::hdf5
