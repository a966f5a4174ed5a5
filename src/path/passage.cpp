#include "path/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::path {
namespace {

/// Steps of the dip that are tried, and how many. A finer search would gain less than a tenth of a
/// millisecond at a corner.
constexpr double kDipStep = 0.05;
constexpr int kDips = 13;

/// Time lost from rest of acceleration at v to the same at F, with jerk alone [s].
double rise_loss(double v, double feedrate, double jerk) noexcept {
  const double gain = std::max(feedrate - v, 0.0);
  return gain * std::sqrt(gain / jerk) / feedrate;
}

/// Time lost on one side with a given dip [s].
double loss_with(double dip, double h, double bump, double feedrate, double jerk) noexcept {
  const double time = 3.0 * h / (bump * (1.0 + 2.0 * dip));
  const double a = 2.0 * bump * (1.0 - dip) / time;
  const double before = a / jerk;  // a rise with J from a = 0 has come to (V, a) after this time
  const double v = bump - 0.5 * a * before;
  if (v < 0.0 || v + a * a / jerk > feedrate * (1.0 + 1e-9)) {
    return std::numeric_limits<double>::infinity();
  }
  const double way = before * (v + jerk * before * before / 6.0);
  return time - h / feedrate + rise_loss(v, feedrate, jerk) - (before - way / feedrate);
}

}  // namespace

Passage best_passage(double half_width, double bump, double feedrate, double jerk) noexcept {
  if (bump >= feedrate) {
    return {};
  }
  Passage best{1.0, loss_with(1.0, half_width, bump, feedrate, jerk)};
  for (int i = 1; i < kDips; ++i) {
    const double dip = 1.0 - kDipStep * i;
    const double loss = loss_with(dip, half_width, bump, feedrate, jerk);
    if (loss < best.loss) {
      best = {dip, loss};
    }
  }
  return best;
}

double stop_loss(double feedrate, double jerk) noexcept { return std::sqrt(feedrate / jerk); }

double feedrate_within(double distance, double feedrate, double jerk) noexcept {
  return std::min(feedrate, std::cbrt(distance * distance * jerk));
}

}  // namespace twin::path
