#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace twin::results::hdf5 {

inline constexpr std::size_t kCodedSymbols = 257;  ///< bytes, and the end of a block
inline constexpr unsigned kLongestCode = 15;       ///< [bits]

using SymbolCounts = std::array<std::uint32_t, kCodedSymbols>;  ///< how often each symbol is there

/// A code of deflate: for each symbol its bits, the first one lowest, and how many they are.
struct HuffmanCode {
  std::array<std::uint16_t, kCodedSymbols> bits{};
  std::array<std::uint8_t, kCodedSymbols> lengths{};  ///< 0: the symbol is not there
};

/// The code of least length (D. A. Huffman, 1952), numbered as RFC 1951, 3.2.2, wants it. Where that
/// has codes above kLongestCode, it is the code of counts that are halved until it has not.
/// @param counts  two of them at least above 0
HuffmanCode make_huffman_code(SymbolCounts counts);

}  // namespace twin::results::hdf5
