#include "nc_programs/generate/linearise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace twin::programs {
namespace {

constexpr double kSlope = 0.2;  // change of chord length per length walked

/// L at every entry of the outline's table for the chord tolerance e [mm].
std::vector<double> chord_lengths(const Outline& outline, const ChordTarget& target, double e) {
  const auto& s = outline.arc_lengths();
  std::vector<double> wanted;
  for (const Frame& f : outline.frames()) {
    const double free = std::sqrt(8.0 * e / std::max(std::abs(f.curvature), 1e-12));
    wanted.push_back(std::clamp(free, target.shortest, target.longest));
  }
  const std::size_t n = s.size();
  for (int lap = 0; lap < 2; ++lap) {  // the second lap carries the limit over the closing point
    for (std::size_t i = 1; i < n; ++i) {
      wanted[i] = std::min(wanted[i], wanted[i - 1] + kSlope * (s[i] - s[i - 1]));
    }
    wanted.front() = std::min(wanted.front(), wanted.back());
    for (std::size_t i = n - 1; i > 0; --i) {
      wanted[i - 1] = std::min(wanted[i - 1], wanted[i] + kSlope * (s[i] - s[i - 1]));
    }
    wanted.back() = std::min(wanted.front(), wanted.back());
  }
  return wanted;
}

/// n(s) at every entry of the table, by the trapezium rule.
std::vector<double> chord_count(const Outline& outline, const ChordTarget& target, double e) {
  const auto& s = outline.arc_lengths();
  const std::vector<double> length = chord_lengths(outline, target, e);
  std::vector<double> n{0.0};
  for (std::size_t i = 1; i < s.size(); ++i) {
    n.push_back(n.back() + 0.5 * (s[i] - s[i - 1]) * (1.0 / length[i] + 1.0 / length[i - 1]));
  }
  return n;
}

/// Value of the piecewise linear function y(x) through the table.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto k = static_cast<std::size_t>(above - x.begin());
  return y[k - 1] + (at - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
}

}  // namespace

Chords linearise(const Outline& outline, const ChordTarget& target, double start) {
  double low = 1e-6;
  double high = 1e-2;
  for (int i = 0; i < 60; ++i) {
    const double e = std::sqrt(low * high);
    (chord_count(outline, target, e).back() > target.blocks ? low : high) = e;
  }
  const double e = std::sqrt(low * high);
  std::vector<double> n = chord_count(outline, target, e);
  const double scale = target.blocks / n.back();  // 1 but for the last bits
  if (std::abs(scale - 1.0) > 1e-9) {
    throw std::runtime_error("no chord tolerance gives " + std::to_string(target.blocks) +
                             " chords, the nearest is " + std::to_string(n.back()));
  }
  for (double& value : n) {
    value *= scale;
  }
  const double from = interpolate(outline.arc_lengths(), n, start);
  Chords out{{}, e};
  for (int i = 0; i < target.blocks; ++i) {
    double count = from + i;
    if (count >= target.blocks) {
      count -= target.blocks;
    }
    out.points.push_back(outline.at(interpolate(n, outline.arc_lengths(), count)).point);
  }
  out.points.push_back(out.points.front());
  return out;
}

}  // namespace twin::programs
