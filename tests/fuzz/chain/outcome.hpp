#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/chain/limit_check.hpp"

namespace twin::fuzz {

/// A promise that was not kept.
struct Breach {
  std::string what;    ///< as "audited jerk", or a sentence
  double share = 0.0;  ///< of what is allowed; 0 where that has no sense
};
std::string to_string(const Breach& breach);

/// What became of a case.
struct Outcome {
  Shares shares{};               ///< NaN where nothing is promised
  std::vector<Breach> findings;  ///< empty: all promises are kept
  std::vector<Breach> known;     ///< the same of defects that are known (known_defects.hpp)
  std::size_t set_points = 0;
  Ending ending = Ending::kNone;
};

/// Share of what a measure allows that is no finding yet. Above 1 where set points alone cannot
/// tell: where the curvature changes within a period, and at corners.
double tolerated(Measure measure);

/// Follows a case and holds its set points against everything that is promised: it ends, within a
/// time proportional to its length and its limits; set points are finite; they begin and end at
/// rest where the program does; they keep the limits; they stay at the programmed path and pass
/// all of it; it is no slower than with a stop after each block.
///
/// @param is_repeated  follows it a second time as well, which must give the same bits
Outcome examine(const Case& made, bool is_repeated);

}  // namespace twin::fuzz
