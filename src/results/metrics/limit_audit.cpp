#include "results/metrics/limit_audit.hpp"

#include <algorithm>
#include <cmath>

namespace twin::results {
namespace {

constexpr double kSmallDoubt = 0.05;  // of the limit
constexpr double kGentleBend = 0.5;   // up to here the mean over a bend follows the series [rad]

// Set points from the latest one back to the middle of what is judged. The step completed last ends
// at set point n - 2, and along_path() judges those about its window's middle.
constexpr std::int64_t kOfFeedrate = 2;
constexpr std::int64_t kOfNormal = 3;
constexpr std::int64_t kAlongPath = 26;

void raise(double& peak, std::int64_t& where, double value, std::int64_t now) noexcept {
  if (std::abs(value) > peak) {
    peak = std::abs(value);
    where = std::max<std::int64_t>(now, 0);
  }
}

}  // namespace

LimitAudit::LimitAudit(double period, const Limits& limits)
    : period_(period), acceleration_limit_(limits.acceleration), jerk_limit_(limits.jerk) {}

void LimitAudit::add(const Vec3& point) noexcept {
  if (!has_started_) {
    has_started_ = true;
    points_.fill(point);
    arc_steps_.reset(point);
  }
  std::rotate(points_.begin(), points_.end() - 1, points_.end());
  points_[0] = point;
  ++latest_;
  judge_axes();

  std::copy(steps_.begin() + 1, steps_.end(), steps_.begin());
  steps_.back() = arc_steps_.push(point);
  judge_normal(steps_[kWindow - 2], steps_[kWindow - 1]);
  raise(peaks_.feedrate, where_.feedrate, steps_.back().arc / period_, latest_ - kOfFeedrate);
  raise(peaks_.tangential_acceleration, where_.tangential_acceleration,
        along_path(2, acceleration_limit_), latest_ - kAlongPath);
  raise(peaks_.tangential_jerk, where_.tangential_jerk, along_path(3, jerk_limit_),
        latest_ - kAlongPath);
}

const AuditPeaks& LimitAudit::finish() noexcept {
  if (has_started_) {
    const Vec3 rest = points_[0];
    for (std::size_t i = 0; i < kWindow + ArcSteps::kDelay; ++i) {
      add(rest);
    }
  }
  return peaks_;
}

void LimitAudit::judge_axes() noexcept {
  const auto& p = points_;
  const Vec3 velocity = (p[0] - p[1]) / period_;
  const Vec3 acceleration = (p[0] - 2.0 * p[1] + p[2]) / (period_ * period_);
  const Vec3 jerk = (p[0] - p[3] - 3.0 * (p[1] - p[2])) / (period_ * period_ * period_);
  raise(peaks_.vector_jerk, where_.vector_jerk, jerk.norm(), latest_ - 1);
  for (Eigen::Index i = 0; i < 3; ++i) {
    AxisPeaks& axis = peaks_.axis[static_cast<std::size_t>(i)];
    OfEachAxisPeak<std::int64_t>& where = where_.axis[static_cast<std::size_t>(i)];
    raise(axis.velocity, where.velocity, velocity[i], latest_);
    raise(axis.acceleration, where.acceleration, acceleration[i], latest_ - 1);
    raise(axis.jerk, where.jerk, jerk[i], latest_ - 1);
  }
}

// The step completed last goes from set point n - 3 to n - 2; points_[k] is set point n - k.
void LimitAudit::judge_normal(const Step& before, const Step& after) noexcept {
  const Vec3 chord = points_[2] - points_[4];
  const double length = chord.norm();
  const Vec3 acceleration = (points_[2] - 2.0 * points_[3] + points_[4]) / (period_ * period_);
  const Vec3 tangent = length > 0.0 ? Vec3(chord / length) : Vec3(Vec3::Zero());
  const double normal = (acceleration - acceleration.dot(tangent) * tangent).norm();
  const double x = std::max(before.bend, after.bend);
  raise(peaks_.normal_acceleration, where_.normal_acceleration,
        x < kGentleBend ? normal * (1.0 + x * x / 12.0) : normal, latest_ - kOfNormal);
}

double LimitAudit::along_path(std::size_t order, double limit) const noexcept {
  double certain = 0.0;
  for (std::size_t m = 1; m <= kLargestScale; m *= 2) {
    std::array<double, 3> arc{};    // of the runs of m periods [mm]
    std::array<double, 3> doubt{};  // Eq. 1 [mm]
    auto step = steps_.begin() + static_cast<std::ptrdiff_t>(kPlace - order * (m - 1) / 2);
    for (std::size_t run = 0; run < order; ++run) {
      for (std::size_t i = 0; i < m; ++i, ++step) {
        arc[run] += step->arc;
        doubt[run] += step->doubt;
      }
    }
    const double time = static_cast<double>(m) * period_;
    double difference = 0.0;
    double open = 0.0;
    if (order == 2) {
      difference = (arc[1] - arc[0]) / (time * time);
      open = (doubt[0] + doubt[1]) / (time * time);
    } else {
      difference = (arc[2] - 2.0 * arc[1] + arc[0]) / (time * time * time);
      open = (doubt[0] + 2.0 * doubt[1] + doubt[2]) / (time * time * time);
    }
    if (open < kSmallDoubt * limit) {
      return difference;
    }
    certain = std::max(std::abs(difference) - open, 0.0);
  }
  return certain;
}

}  // namespace twin::results
