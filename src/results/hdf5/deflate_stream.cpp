#include "results/hdf5/deflate_stream.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "results/hdf5/huffman_code.hpp"

namespace twin::results::hdf5 {
namespace {

constexpr std::size_t kLongestStored = 65535;
constexpr unsigned kStored = 0;  // kinds of blocks
constexpr unsigned kOwnCode = 2;
constexpr std::array<unsigned, 19> kOrderOfLengths{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                   11, 4,  12, 3, 13, 2, 14, 1, 15};

}  // namespace

void DeflateStream::put(std::uint64_t bits, unsigned count) {
  waiting_ |= bits << count_;
  count_ += count;
  while (count_ >= 8) {
    packed_.push_back(static_cast<std::uint8_t>(waiting_));
    waiting_ >>= 8U;
    count_ -= 8;
  }
}

void DeflateStream::put_stored(std::span<const std::uint8_t> bytes) {
  assert(bytes.size() <= kLongestStored);
  put(kStored << 1U, 3);
  put(0, (8 - count_) % 8);
  const std::uint64_t size = bytes.size();
  put(size | (size ^ kLongestStored) << 16U, 32);
  packed_.insert(packed_.end(), bytes.begin(), bytes.end());
}

void DeflateStream::align() {
  if (count_ > 0) {
    put_stored({});
  }
}

/// The lengths of a code, each by four bits, and one code of distances that is not there.
void DeflateStream::put_header(std::span<const std::uint8_t> lengths) {
  put(kOwnCode << 1U, 3);
  put(lengths.size() - 257, 5);
  put(0, 5);
  put(kOrderOfLengths.size() - 4, 4);
  for (const unsigned symbol : kOrderOfLengths) {
    put(symbol <= kLongestCode ? 4 : 0, 3);
  }
  const auto put_length = [this](unsigned length) {
    const unsigned reversed = ((length & 1U) << 3U) | ((length & 2U) << 1U) |
                              ((length & 4U) >> 1U) | ((length & 8U) >> 3U);
    put(reversed, 4);
  };
  for (const std::uint8_t length : lengths) {
    put_length(length);
  }
  put_length(0);
}

void DeflateStream::put_coded(std::span<const std::uint8_t> bytes) {
  SymbolCounts counts{};
  for (const std::uint8_t byte : bytes) {
    ++counts[byte];
  }
  counts.back() = 1;
  const HuffmanCode code = make_huffman_code(counts);
  put_header(code.lengths);
  put_symbols(bytes, code);
  put(code.bits.back(), code.lengths.back());
}

/// Whole words go out, of which the next one overwrites what was no whole byte yet.
void DeflateStream::put_symbols(std::span<const std::uint8_t> bytes, const HuffmanCode& code) {
  constexpr std::size_t kAtOnce = 3;  // with what waits at most 7 + 3 x 15 bits
  std::size_t end = packed_.size();
  packed_.resize(end + (bytes.size() * kLongestCode) / 8 + 2 * sizeof waiting_);
  std::uint64_t waiting = waiting_;
  unsigned count = count_;
  const auto flush = [&] {
    for (std::size_t i = 0; i < sizeof waiting; ++i) {  // a word, low byte first
      packed_[end + i] = static_cast<std::uint8_t>(waiting >> (8 * i));
    }
    end += count / 8;
    waiting >>= count / 8 * 8;
    count %= 8;
  };
  for (std::size_t i = 0; i < bytes.size();) {
    for (const std::size_t stop = std::min(i + kAtOnce, bytes.size()); i < stop; ++i) {
      waiting |= static_cast<std::uint64_t>(code.bits[bytes[i]]) << count;
      count += code.lengths[bytes[i]];
    }
    flush();
  }
  packed_.resize(end);
  waiting_ = waiting;
  count_ = count;
}

}  // namespace twin::results::hdf5
