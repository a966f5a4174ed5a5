#include "feedrate/bound/reach.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

constexpr double kFlat = 1e-12;  // share of the acceleration in a limit that is none [-]

/// u against q: value + slope q.
struct Bend {
  double value;
  double slope;

  double at(double q) const noexcept { return value + slope * q; }
};

/// Lines between which u lies.
struct Region {
  std::array<Bend, 9> lower{};
  std::array<Bend, 9> upper{};
  std::size_t lowers = 0;
  std::size_t uppers = 0;
  double cap;  // of q

  void above(const Bend& line) noexcept { lower[lowers++] = line; }
  void below(const Bend& line) noexcept { upper[uppers++] = line; }
};

/// The limits of a cell as lines, with 0 <= q + 2 u l <= end.
Region region_of(const Cell& cell, double end) noexcept {
  Region region{};
  region.cap = cell.cap;
  const double per_length = 0.5 / cell.length;
  region.above({-cell.acceleration, 0.0});
  region.below({cell.acceleration, 0.0});
  region.above({0.0, -per_length});
  region.below({end * per_length, -per_length});
  for (std::size_t i = 0; i < cell.strips.count; ++i) {
    const Strip& s = cell.strips.strip[i];
    if (std::abs(s.a) < kFlat) {
      region.cap = s.b != 0.0 ? std::min(region.cap, s.c / std::abs(s.b)) : region.cap;
      continue;
    }
    const double half = s.c / std::abs(s.a);
    region.above({-half, -s.b / s.a});
    region.below({half, -s.b / s.a});
  }
  return region;
}

}  // namespace

double largest_begin(const Cell& cell, double end) noexcept {
  if (cell.strips.count == 0) {
    return std::min(cell.cap, end + 2.0 * cell.acceleration * cell.length);
  }
  const Region region = region_of(cell, end);
  double q = region.cap;
  for (std::size_t i = 0; i < region.lowers; ++i) {
    for (std::size_t j = 0; j < region.uppers; ++j) {
      const double closing = region.lower[i].slope - region.upper[j].slope;
      if (closing > 0.0) {
        q = std::min(q, (region.upper[j].value - region.lower[i].value) / closing);
      }
    }
  }
  return std::max(q, 0.0);
}

double largest_end(const Cell& cell, double begin, double end) noexcept {
  if (cell.strips.count == 0) {
    return std::min(end, begin + 2.0 * cell.acceleration * cell.length);
  }
  const Region region = region_of(cell, end);
  double u = region.upper[0].at(begin);
  for (std::size_t j = 1; j < region.uppers; ++j) {
    u = std::min(u, region.upper[j].at(begin));
  }
  return std::clamp(begin + 2.0 * u * cell.length, 0.0, end);
}

bool is_linear(const Cell& cell, double begin, double end) noexcept {
  return cell.strips.count > 0 && begin + end > 0.0;
}

double cell_peak(const Cell& cell, double begin, double end) noexcept {
  const double higher = std::max(begin, end);
  if (is_linear(cell, begin, end)) {
    return higher;
  }
  const double peak = 0.5 * (begin + end) + cell.acceleration * cell.length;
  return std::max(higher, std::min(cell.cap, peak));
}

double cell_time(const Cell& cell, double begin, double end) noexcept {
  if (cell.length <= 0.0) {
    return 0.0;
  }
  const double v0 = std::sqrt(begin);
  const double v1 = std::sqrt(end);
  if (is_linear(cell, begin, end)) {
    return 2.0 * cell.length / (v0 + v1);
  }
  const double peak = cell_peak(cell, begin, end);
  const double v = std::sqrt(peak);
  const double a = cell.acceleration;
  const double hold = cell.length - (peak - begin + peak - end) / (2.0 * a);
  return (v - v0 + v - v1) / a + std::max(hold, 0.0) / v;
}

}  // namespace twin::feedrate
