#pragma once

#include <array>
#include <string>
#include <vector>

#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// True where ours / published is 1 within a share: |ours / published - 1| <= share.
bool is_within(double ours, double published, double share);

/// Shares within which our numbers are counted [-].
inline constexpr std::array<double, 3> kShares{0.10, 0.20, 0.30};

/// Whose numbers are held against the published ones.
enum class Of { kSingle, kMean };

/// How many of the measured numbers (Tables 4 and 5) lie within each of kShares.
struct Counts {
  std::array<int, kShares.size()> within{};
  int total = 0;
  double worst_time = 0.0;  ///< machining time / published - 1, the largest by magnitude [-]
};
Counts count(const Variant& variant, Of of);

/// Our number i of a row; the mean is that of the single run where nothing was repeated.
double ours(const Answer& answer, std::size_t i, Of of);

/// Names of a row's numbers that lie outside the last of kShares: "X max, Y max", or nothing.
std::string missed(const Answer& answer, Of of);

}  // namespace twin::studies::reproduce
