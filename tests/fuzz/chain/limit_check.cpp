#include "tests/fuzz/chain/limit_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "results/metrics/limit_audit.hpp"
#include "tests/support/way_between.hpp"

namespace twin::fuzz {
namespace {

/// Places of set points are rounded, by the search for the length along a curve above all [mm].
constexpr double kRounding = 1e-10;
/// Set points farther off a common line or circle than this share of the way that the jerk changes
/// in a period are not on it.
constexpr double kOffShare = 1e-3;

/// A third difference over single periods spans so many set points on either side of its middle.
constexpr std::int64_t kHidingPeriods = 3;
/// Set points at rest after the last one, until the audit has judged all.
constexpr std::size_t kAfterwards = 64;

double highest_feedrate(const Case& made) {
  double programmed = 0.0;
  double percent = 100.0;
  for (const Piece& piece : made.program.pieces) {
    programmed = std::max(programmed, piece.feedrate);
  }
  for (const runtime::OverrideChange& change : made.operations) {
    percent = std::max(percent, change.percent);
  }
  const bool exceeds = made.machine.planning.feedrate_rule == FeedrateRule::kContactSpeed;
  const double limit = made.machine.limits.feedrate;
  return exceeds ? limit : std::min(limit, programmed * percent / 100.0);
}

/// Where the programmed path turns back: ends of blocks.
std::vector<Vec3> turns_back(const MadeProgram& program) {
  std::vector<Vec3> places;
  const Shape* before = nullptr;
  for (const Piece& piece : program.pieces) {
    const std::vector<Vec3>& points = piece.shape.points;
    if (points.size() < 2) {
      continue;
    }
    if (before != nullptr) {
      const auto& old = before->points;
      const Vec3 in = old.back() - old[old.size() - 2];
      if (in.dot(points[1] - points[0]) < 0.0) {
        places.push_back(points.front());
      }
    }
    before = &piece.shape;
  }
  return places;
}

/// Whether the path may turn back within a step of these points, unseen by any of them: nobody can
/// tell how far it went there.
bool may_turn_back(std::span<const Vec3> p, const std::vector<Vec3>& turns_back) {
  if (turns_back.empty()) {
    return false;
  }
  double step = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    step = std::max(step, (p[i] - p[i - 1]).norm());
  }
  return std::any_of(turns_back.begin(), turns_back.end(), [&](const Vec3& place) {
    return std::any_of(p.begin(), p.end(),
                       [&](const Vec3& point) { return (point - place).norm() <= step; });
  });
}

/// Raises the peaks of one place after the other.
class Peaks {
 public:
  Peaks(const Case& made, Shares& shares)
      : limits_(made.machine.limits),
        period_(made.machine.period),
        feedrate_(highest_feedrate(made)),
        off_(std::clamp(kOffShare * limits_.jerk * std::pow(period_, 3), 1e-12, 4e-9)),
        turns_back_(turns_back(made.program)),
        shares_(shares) {}

  /// @param around  six successive set points
  void look(std::span<const Vec3, 6> p) {
    const double t2 = period_ * period_;
    raise(Measure::kFeedrate, (p[5] - p[4]).norm() - 2.0 * kRounding, feedrate_ * period_);
    raise(Measure::kVectorAcceleration, (p[5] - 2.0 * p[4] + p[3]).norm() - 4.0 * kRounding,
          std::numbers::sqrt2 * limits_.acceleration * t2);
    if ((p[5] - p[3]).norm() > 100.0 * kRounding) {
      raise(Measure::kRawNormal,
            test::normal_acceleration(p[3], p[4], p[5], period_) * t2 - 4.0 * kRounding,
            limits_.acceleration * t2);
    }
    look_at_axes(p);
    if (const auto s = test::lengths_between(p, off_); s && !may_turn_back(p, turns_back_)) {
      const auto& [a, b, c] = *s;
      raise(Measure::kRawTangential, std::max(std::abs(b - a), std::abs(c - b)) - 4.0 * kRounding,
            limits_.acceleration * t2);
      raise(Measure::kRawJerk, std::abs(c - 2.0 * b + a) - 8.0 * kRounding,
            limits_.jerk * t2 * period_);
    }
  }

 private:
  void raise(Measure measure, double value, double allowed) {
    double& share = share_of(shares_, measure);
    share = std::max(std::isnan(share) ? 0.0 : share, value / allowed);
  }

  void look_at_axes(std::span<const Vec3, 6> p) {
    const Vec3 step = (p[5] - p[4]).cwiseAbs();
    const Vec3 second = (p[5] - 2.0 * p[4] + p[3]).cwiseAbs();
    const Vec3 third = (p[5] - 3.0 * p[4] + 3.0 * p[3] - p[2]).cwiseAbs();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (limits_.axis_feedrate[i] > 0.0) {
        raise(Measure::kAxisFeedrate, step[i] - 2.0 * kRounding,
              limits_.axis_feedrate[i] * period_);
      }
      if (limits_.axis_acceleration[i] > 0.0) {
        raise(Measure::kAxisAcceleration, second[i] - 4.0 * kRounding,
              limits_.axis_acceleration[i] * period_ * period_);
      }
      if (limits_.axis_jerk[i] > 0.0) {
        raise(Measure::kAxisJerk, third[i] - 8.0 * kRounding,
              limits_.axis_jerk[i] * std::pow(period_, 3));
      }
    }
  }

  const Limits& limits_;
  double period_;
  double feedrate_;
  double off_;
  std::vector<Vec3> turns_back_;
  Shares& shares_;
};

/// Peaks of results::LimitAudit. A jerk counts only where the path cannot have turned back unseen.
void audit(const Case& made, const Trajectory& trajectory, Shares& shares) {
  const Limits& limits = made.machine.limits;
  const double period = made.machine.period;
  const std::vector<Vec3>& points = trajectory.points;
  const std::vector<Vec3> places = turns_back(made.program);
  const auto is_hidden = [&](std::int64_t number) {
    const std::int64_t first = std::max<std::int64_t>(number - kHidingPeriods, 0);
    const std::int64_t last =
        std::min(number + kHidingPeriods + 1, static_cast<std::int64_t>(points.size()));
    return first < last && may_turn_back({points.begin() + first, points.begin() + last}, places);
  };
  results::LimitAudit audit(period, limits);
  results::AuditPeaks peaks;
  for (std::size_t i = 0; i < points.size() + kAfterwards; ++i) {
    audit.add(points[std::min(i, points.size() - 1)]);
    const results::AuditPeaks& now = audit.peaks();
    peaks.tangential_acceleration =
        std::max(peaks.tangential_acceleration, now.tangential_acceleration);
    if (now.tangential_jerk > peaks.tangential_jerk && !is_hidden(audit.where().tangential_jerk)) {
      peaks.tangential_jerk = now.tangential_jerk;
    }
    audit.forget_peaks();
  }
  share_of(shares, Measure::kTangential) =
      (peaks.tangential_acceleration - 4.0 * kRounding / std::pow(period, 2)) / limits.acceleration;
  share_of(shares, Measure::kJerk) =
      (peaks.tangential_jerk - 8.0 * kRounding / std::pow(period, 3)) / limits.jerk;
}

/// Forgets what these settings do not promise.
void drop_unpromised(const config::MachineFile& machine, Shares& shares) {
  const auto drop = [&](std::initializer_list<Measure> measures) {
    for (const Measure measure : measures) {
      share_of(shares, measure) = NAN;
    }
  };
  const bool is_paper = machine.path.planner == Planner::kPaper;
  const FeedrateRule rule = machine.planning.feedrate_rule;
  // The planner of the paper has no limits of single axes, and a rule that leaves out the normal
  // acceleration: then the way between set points cannot be told from them.
  if (is_paper) {
    drop({Measure::kAxisFeedrate, Measure::kAxisAcceleration, Measure::kAxisJerk});
  }
  const bool is_constant =
      rule == FeedrateRule::kConstant ||
      (rule == FeedrateRule::kAuto && machine.path.curves == CurveKind::kBezier);
  if (is_paper && is_constant) {
    drop({Measure::kVectorAcceleration, Measure::kRawNormal, Measure::kRawTangential,
          Measure::kRawJerk, Measure::kTangential, Measure::kJerk});
  }
  // Landing on the end of a curve makes a short step, and a parameter that is not corrected runs
  // unevenly.
  if (machine.interpolation.curve_end == motion::CurveEnd::kLand ||
      machine.interpolation.update != motion::ParameterUpdate::kCorrected) {
    drop({Measure::kFeedrate, Measure::kVectorAcceleration, Measure::kRawTangential,
          Measure::kRawJerk, Measure::kRawNormal, Measure::kTangential, Measure::kJerk,
          Measure::kAxisFeedrate, Measure::kAxisAcceleration, Measure::kAxisJerk});
  }
}

}  // namespace

std::string_view name_of(Measure measure) {
  static constexpr std::array<std::string_view, kMeasures> kNames{
      "feedrate",      "vector acceleration",     "raw tangential acceleration",
      "raw jerk",      "raw normal acceleration", "audited tangential acceleration",
      "audited jerk",  "axis feedrate",           "axis acceleration",
      "axis jerk",     "distance from the path",  "ends of blocks passed",
      "machining time"};
  return kNames[static_cast<std::size_t>(measure)];
}

void measure_limits(const Case& made, const Trajectory& trajectory, Shares& shares) {
  std::vector<Vec3> points(5, trajectory.points.front());  // rest before
  points.insert(points.end(), trajectory.points.begin(), trajectory.points.end());
  points.insert(points.end(), 5, trajectory.points.back());  // and after
  Peaks peaks(made, shares);
  for (std::size_t i = 6; i <= points.size(); ++i) {
    peaks.look(std::span<const Vec3, 6>(&points[i - 6], 6));
  }
  audit(made, trajectory, shares);
  drop_unpromised(made.machine, shares);
}

}  // namespace twin::fuzz
