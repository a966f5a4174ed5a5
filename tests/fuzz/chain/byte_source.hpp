#pragma once

#include <cstddef>
#include <initializer_list>

#include "tests/fuzz/target.hpp"

namespace twin::fuzz {

/// Makes choices and numbers from bytes, one after the other; when the bytes are used up, every
/// further byte is 0. So each string of bytes means something, and a change of a byte changes one
/// choice.
class ByteSource {
 public:
  explicit ByteSource(Bytes bytes) : bytes_(bytes), size_(bytes.size()) {}

  /// How many bytes have been used.
  std::size_t used() const noexcept { return size_ - bytes_.size(); }
  bool is_empty() const noexcept { return bytes_.empty(); }
  /// The next byte.
  unsigned byte() noexcept;
  /// One of `count` choices, from 0; takes a byte.
  std::size_t choice(std::size_t count) noexcept { return byte() % count; }
  /// True in `share` of 256 values of a byte.
  bool happens(unsigned share) noexcept { return byte() >= 256U - share; }
  /// One of these values.
  double one_of(std::initializer_list<double> values) noexcept {
    return values.begin()[choice(values.size())];
  }
  /// Between two ends; takes two bytes.
  double uniform(double low, double high) noexcept;
  /// Between two positive ends, every factor equally likely; takes two bytes.
  double log_uniform(double low, double high) noexcept;

 private:
  Bytes bytes_;  // not used yet
  std::size_t size_;
};

}  // namespace twin::fuzz
