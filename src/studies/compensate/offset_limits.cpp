#include "studies/compensate/offset_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace twin::studies::compensate {
namespace {

using results::AuditPeaks;

constexpr std::size_t kStretch = 8;   // set points whose peaks are judged together
constexpr int kRounds = 60;           // of audit and mending
constexpr std::ptrdiff_t kDip = 48;   // half width of a dip [periods]
constexpr std::ptrdiff_t kHeld = 26;  // half width of an excess [periods]
constexpr double kSlack = 0.98;       // of a limit, so that mending comes to an end
constexpr double kMost = 50.0;        // excess of one round

/// Limits as peaks; huge where there is none.
AuditPeaks limit_peaks(const Limits& limits) {
  constexpr double kNone = 1e300;
  const auto some = [](double limit) { return limit > 0.0 ? limit : kNone; };
  AuditPeaks peaks;
  results::for_each_peak([](double& peak) { peak = kNone; }, peaks);
  peaks.feedrate = limits.feedrate;
  peaks.tangential_acceleration = peaks.normal_acceleration = limits.acceleration;
  peaks.tangential_jerk = limits.jerk;
  if (limits.jerk_of == JerkOf::kVector) {
    peaks.vector_jerk = limits.jerk;
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    peaks.axis[static_cast<std::size_t>(i)] = {some(limits.axis_feedrate[i]),
                                               some(limits.axis_acceleration[i]),
                                               some(limits.axis_jerk[i])};
  }
  return peaks;
}

void raise_about(std::ptrdiff_t middle, double factor, std::vector<double>& factors) {
  const auto count = static_cast<std::ptrdiff_t>(factors.size());
  for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(middle - kHeld, 0);
       k <= std::min(middle + kHeld, count - 1); ++k) {
    double& there = factors[static_cast<std::size_t>(k)];
    there = std::max(there, factor);
  }
}

/// Weights with a smooth dip to 1 / factor about each place where a factor is above 1.
std::vector<double> dips(const Excess& excess) {
  const std::size_t count = excess.tangential.size();
  std::vector<double> weights(count, 1.0);
  for (std::size_t place = 0; place < count; ++place) {
    const double factor = std::max(excess.tangential[place], excess.normal[place]);
    if (factor <= 1.0) {
      continue;
    }
    const auto middle = static_cast<std::ptrdiff_t>(place);
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(middle - kDip, 0);
         k <= std::min(middle + kDip, static_cast<std::ptrdiff_t>(count) - 1); ++k) {
      const double x = static_cast<double>(k - middle) / static_cast<double>(kDip);
      const double depth = 0.5 + 0.5 * std::cos(std::numbers::pi * x);
      double& weight = weights[static_cast<std::size_t>(k)];
      weight = std::min(weight, 1.0 - (1.0 - 1.0 / factor) * depth);
    }
  }
  return weights;
}

}  // namespace

OffsetAudit::OffsetAudit(std::span<const motion::SetPoint> points, const OffsetLimits& limits)
    : points_(points), limits_(limits), plain_(audit({})) {}

std::vector<OffsetAudit::Stretch> OffsetAudit::audit(std::span<const Vec2> offsets) const {
  std::vector<Stretch> stretches;
  results::LimitAudit audit(limits_.period, limits_.machine);
  const auto take = [&] {
    stretches.push_back({audit.peaks(), audit.where()});
    audit.forget_peaks();
  };
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Vec3 point = points_[k].position;
    if (!offsets.empty()) {
      point.head<2>() += offsets[k];
    }
    audit.add(point);
    if ((k + 1) % kStretch == 0) {
      take();
    }
  }
  audit.finish();
  take();
  return stretches;
}

Excess OffsetAudit::excess(std::span<const Vec2> offsets) const {
  const AuditPeaks limits = limit_peaks(limits_.machine);
  const std::vector<Stretch> corrected = audit(offsets);
  Excess excess;
  excess.tangential.assign(points_.size(), 1.0);
  excess.normal.assign(points_.size(), 1.0);
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    const AuditPeaks& peaks = corrected[i].peaks;
    results::for_each_peak(
        [&](double before, const double& after, double limit, std::int64_t where) {
          if (after <= std::max(limit, before * (1.0 + 1e-9))) {
            return;
          }
          excess.is_kept = false;
          const double room = std::max(kSlack * limit - before, 0.0);
          const double factor = std::clamp((after - before) / std::max(room, 1e-9), 1.05, kMost);
          const bool is_normal = &after == &peaks.normal_acceleration;
          const auto place = static_cast<std::ptrdiff_t>(where);
          raise_about(place, factor, is_normal ? excess.normal : excess.tangential);
        },
        plain_[i].peaks, peaks, limits, corrected[i].where);
  }
  return excess;
}

void OffsetAudit::clamp(std::vector<Vec2>& offsets) const {
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const double place = points_[k].position[axis];
      const double low = std::min(limits_.machine.travel_min[axis] - place, 0.0);
      const double high = std::max(limits_.machine.travel_max[axis] - place, 0.0);
      offsets[k][axis] = std::clamp(offsets[k][axis], std::max(-limits_.largest, low),
                                    std::min(limits_.largest, high));
    }
  }
}

bool OffsetAudit::mend(std::vector<Vec2>& offsets) const {
  clamp(offsets);
  for (int round = 0; round < kRounds; ++round) {
    const Excess found = excess(offsets);
    if (found.is_kept) {
      return true;
    }
    const std::vector<double> weights = dips(found);
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      offsets[k] *= weights[k];
    }
  }
  std::ranges::fill(offsets, Vec2(Vec2::Zero()));
  return false;
}

}  // namespace twin::studies::compensate
