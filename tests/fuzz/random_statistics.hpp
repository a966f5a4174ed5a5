#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/chain/outcome.hpp"

namespace twin::fuzz {

/// Programs that broke the same promise under the same planner.
struct BreachKind {
  std::array<std::uint64_t, 5> counts{};  ///< by size: up to 2 %, 10 %, 50 %, 100 % too much, more
  double largest = 0.0;                   ///< share of what is allowed
  std::uint64_t worst = 0;                ///< number of the program with the largest share
  std::uint64_t first = 0;                ///< and of the first one
};

/// What many random programs came to.
class RandomStatistics {
 public:
  /// @param made  what the program was made of: it tells kinds of breaches apart
  void add(std::uint64_t number, const Case& made, const Outcome& outcome);
  void add(const RandomStatistics& other);

  bool is_clean() const noexcept { return broken_ == 0; }
  /// Counts, how near each limit comes (quantiles of the largest share of what is allowed in each
  /// program), and the breaches by kind and size.
  std::string text() const;

 private:
  std::string limits_text() const;
  std::string kinds_text() const;

  std::array<std::vector<float>, kMeasures> shares_;
  std::map<Ending, std::uint64_t> endings_;
  std::uint64_t programs_ = 0;
  std::uint64_t set_points_ = 0;
  std::uint64_t known_ = 0;   // programs that only show known defects
  std::uint64_t broken_ = 0;  // programs that break a promise otherwise
  std::map<std::string, BreachKind> kinds_;
};

/// The bytes that random program `number` of a seed is made from.
std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::uint64_t number);

}  // namespace twin::fuzz
