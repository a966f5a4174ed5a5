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

constexpr int kNewtonSteps = 50;  // far more than it takes

/// Time lost from rest of acceleration at v to the same at F, with jerk alone [s].
double rise_loss(double v, double feedrate, double jerk) noexcept {
  const double gain = std::max(feedrate - v, 0.0);
  return gain * std::sqrt(gain / jerk) / feedrate;
}

/// Time that a rise from a feedrate with a constant jerk and no acceleration takes over a distance:
/// the root of v T + J T^3 / 6 = h [s].
double rise_duration(double v, double jerk, double h) noexcept {
  double time = h / v;  // no less than the root, from where Newton's method falls to it
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double excess = time * (v + jerk * time * time / 6.0) - h;
    const double step = excess / (v + 0.5 * jerk * time * time);
    time -= step;
    if (step <= 1e-12 * time) {
      break;
    }
  }
  return time;
}

/// Time lost on one side with a given dip [s].
double loss_with(double dip, const Bump& bump, double feedrate, double jerk) noexcept {
  const double h = bump.half_width;
  double time = 3.0 * h / (bump.feedrate * (1.0 + 2.0 * dip));
  double inside = 2.0 * bump.feedrate * (1.0 - dip) / (time * time);
  double end = bump.feedrate;
  if (inside > bump.jerk) {
    inside = bump.jerk;
    time = rise_duration(dip * bump.feedrate, inside, h);
    end = dip * bump.feedrate + 0.5 * inside * time * time;
  }
  const double a = inside * time;
  const double before = a / jerk;  // a rise with J from a = 0 has come to (end, a) after this time
  const double v = end - 0.5 * a * before;
  if (v < 0.0 || v + a * a / jerk > feedrate * (1.0 + 1e-9)) {
    return std::numeric_limits<double>::infinity();
  }
  const double way = before * (v + jerk * before * before / 6.0);
  return time - h / feedrate + rise_loss(v, feedrate, jerk) - (before - way / feedrate);
}

}  // namespace

Passage best_passage(const Bump& bump, double feedrate, double jerk) noexcept {
  if (bump.feedrate >= feedrate) {
    return {};
  }
  Passage best{1.0, loss_with(1.0, bump, feedrate, jerk)};
  for (int i = 1; i < kDips; ++i) {
    const double dip = 1.0 - kDipStep * i;
    const double loss = loss_with(dip, bump, feedrate, jerk);
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
