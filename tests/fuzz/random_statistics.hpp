#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/chain/outcome.hpp"

namespace twin::fuzz {

/// A case that broke a promise.
struct Breach {
  std::uint64_t number = 0;  ///< of the program
  std::vector<std::string> findings;
};

/// What many random programs came to.
class RandomStatistics {
 public:
  void add(std::uint64_t number, const Outcome& outcome);
  void add(const RandomStatistics& other);

  bool is_clean() const noexcept { return breaches_.empty(); }
  /// Counts, how near each limit comes (quantiles of the largest share of what is allowed in each
  /// program), and the breaches by kind and size.
  std::string text() const;

 private:
  std::array<std::vector<float>, kMeasures> shares_;
  std::map<Ending, std::uint64_t> endings_;
  std::uint64_t programs_ = 0;
  std::uint64_t set_points_ = 0;
  std::uint64_t known_ = 0;  // programs that only show known defects
  std::vector<Breach> breaches_;
};

/// The bytes that random program `number` of a seed is made from.
std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::uint64_t number);

}  // namespace twin::fuzz
