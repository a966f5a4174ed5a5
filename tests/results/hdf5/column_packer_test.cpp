#include "results/hdf5/column_packer.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "results/hdf5/huffman_code.hpp"

namespace twin::results::hdf5 {
namespace column_packer_test {

constexpr std::size_t kValues = 8192;

/// What HDF5's filters make of packed bytes: inflated by a library, then unshuffled.
std::vector<std::uint64_t> unpack(std::span<const std::uint8_t> packed) {
  std::vector<std::uint8_t> bytes(8 * kValues);
  libdeflate_decompressor* const decompressor = libdeflate_alloc_decompressor();
  const libdeflate_result result = libdeflate_zlib_decompress(
      decompressor, packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr);
  libdeflate_free_decompressor(decompressor);
  EXPECT_EQ(result, LIBDEFLATE_SUCCESS);
  std::vector<std::uint64_t> values(kValues);
  for (std::size_t i = 0; i < kValues; ++i) {
    for (std::size_t plane = 0; plane < 8; ++plane) {
      values[i] |= std::uint64_t{bytes[plane * kValues + i]} << (8 * plane);
    }
  }
  return values;
}

/// A value of which each byte is below a bound: 256 is noise, 2 to 20 few values, 1 always zero.
std::vector<std::uint64_t> random_values(const std::array<unsigned, 8>& bounds,
                                         std::mt19937_64& random) {
  std::vector<std::uint64_t> values(kValues);
  for (std::uint64_t& value : values) {
    for (std::size_t plane = 0; plane < bounds.size(); ++plane) {
      value |= std::uint64_t{random() % bounds[plane]} << (8 * plane);
    }
  }
  return values;
}

TEST(ColumnPacker, AnotherLibraryUnpacksNoiseAndFewValuesInAnyOrder) {
  std::mt19937_64 random(1);
  ColumnPacker packer;
  constexpr std::array<unsigned, 6> kBounds{1, 2, 7, 20, 90, 256};
  for (int i = 0; i < 200; ++i) {
    std::array<unsigned, 8> bounds{};
    for (unsigned& bound : bounds) {
      bound = kBounds[random() % kBounds.size()];
    }
    const std::vector<std::uint64_t> values = random_values(bounds, random);
    ASSERT_EQ(unpack(packer.pack(values, true)), values) << i;
    ASSERT_EQ(unpack(packer.pack(values, false)), values) << i;
  }
}

TEST(ColumnPacker, FewValuesBelowNoiseTakeTheirEntropy) {
  std::mt19937_64 random(2);
  ColumnPacker packer;
  const auto values = random_values({4, 256, 256, 1, 1, 1, 1, 1}, random);
  const double noise = 2.0 * kValues;
  const double few = 2.0 / 8.0 * kValues;
  EXPECT_LT(static_cast<double>(packer.pack(values, true).size()), 1.03 * (noise + few));
}

TEST(HuffmanCode, OfCountsThatGrowAsFibonaccisIsNoLongerThanDeflateTakes) {
  SymbolCounts counts{};
  std::uint32_t a = 1;
  std::uint32_t b = 1;
  for (std::size_t symbol = 0; symbol < 30; ++symbol) {
    counts[symbol] = a;
    b = std::exchange(a, a + b);
  }
  const HuffmanCode code = make_huffman_code(counts);
  double kraft = 0.0;
  for (const std::uint8_t length : code.lengths) {
    EXPECT_LE(length, kLongestCode);
    kraft += length > 0 ? std::exp2(-length) : 0.0;
  }
  EXPECT_DOUBLE_EQ(kraft, 1.0);  // no word is left over
}

TEST(HuffmanCode, IsWithinABitOfTheEntropy) {
  SymbolCounts counts{};
  double all = 0.0;
  for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
    counts[symbol] = static_cast<std::uint32_t>(symbol * symbol % 101);
    all += counts[symbol];
  }
  const HuffmanCode code = make_huffman_code(counts);
  double entropy = 0.0;
  double bits = 0.0;
  for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
    if (counts[symbol] > 0) {
      entropy -= counts[symbol] / all * std::log2(counts[symbol] / all);
      bits += counts[symbol] / all * code.lengths[symbol];
    }
  }
  EXPECT_GE(bits, entropy);
  EXPECT_LT(bits, entropy + 0.1);
}

}  // namespace column_packer_test
}  // namespace twin::results::hdf5
