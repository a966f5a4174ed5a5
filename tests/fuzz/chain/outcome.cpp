#include "tests/fuzz/chain/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/fuzz/chain/distance_check.hpp"
#include "tests/fuzz/chain/known_defects.hpp"

namespace twin::fuzz {
namespace {

constexpr double kPlace = 1e-6;  // where the program begins and ends [mm]

/// Whether the program has a NURBS that stands still somewhere, which the reader refuses.
bool is_lawful_refusal(const std::string& error) {
  return error.find("no tangent at parameter") != std::string::npos ||
         error.find("no length") != std::string::npos;
}

/// A time can be judged only where nobody interferes.
void measure_time(const Case& made, const Trajectory& trajectory, Shares& shares) {
  const config::MachineFile& machine = made.machine;
  const bool is_fast = machine.planning.feedrate_rule == FeedrateRule::kAuto ||
                       machine.planning.feedrate_rule == FeedrateRule::kConstant;
  if (trajectory.ending != Ending::kWhole || !made.operations.empty() || !is_fast) {
    return;
  }
  // A period at the end of each block may be lost to rounding, and nobody is held to less.
  const double lost = 2.0 + static_cast<double>(made.program.pieces.size());
  const double steps = static_cast<double>(trajectory.points.size()) - lost;
  share_of(shares, Measure::kTime) = std::max(steps, 0.0) * machine.period / made.reference_time;
}

void judge_ends(const Case& made, const Trajectory& trajectory, Outcome& outcome) {
  const auto say = [&](std::string what) { outcome.findings.push_back({std::move(what)}); };
  if (!(trajectory.points.front().norm() < kPlace)) {
    say("the first set point is not where the program begins");
  }
  // A parameter that is not corrected ends where its rounding takes it.
  const bool is_exact = made.machine.interpolation.update == motion::ParameterUpdate::kCorrected;
  const Vec3& end = made.program.pieces.back().shape.points.back();
  if (is_exact && trajectory.ending == Ending::kWhole &&
      !((trajectory.points.back() - end).norm() < kPlace)) {
    say("the last set point is not where the program ends");
  }
}

void judge_shares(const Case& made, Outcome& outcome) {
  for (std::size_t i = 0; i < kMeasures; ++i) {
    const auto measure = static_cast<Measure>(i);
    const double share = outcome.shares[i];
    if (share <= tolerated(measure) || std::isnan(share)) {
      continue;
    }
    const std::string_view defect = known_defect(made, measure, share);
    (defect.empty() ? outcome.findings : outcome.known)
        .push_back({std::string(name_of(measure)), share});
  }
}

}  // namespace

std::string to_string(const Breach& breach) {
  return breach.share > 0.0
             ? fmt::format("{} is {:.4g} times what is allowed", breach.what, breach.share)
             : breach.what;
}

double tolerated(Measure measure) {
  switch (measure) {
    case Measure::kFeedrate:
    case Measure::kAxisFeedrate:
      return 1.0001;
    case Measure::kRawTangential:
    case Measure::kRawJerk:
    case Measure::kAxisAcceleration:
    case Measure::kAxisJerk:
      return 1.001;
    case Measure::kVectorAcceleration:
    case Measure::kRawNormal:
      return 1.02;
    case Measure::kTangential:  // the audit takes what is in doubt by 5 % at most
      return 1.05;
    case Measure::kJerk:
      return 1.07;
    case Measure::kTime:
      return 1.01;
    default:
      return 1.0;
  }
}

Outcome examine(const Case& made, bool is_repeated) {
  Outcome outcome;
  outcome.shares.fill(NAN);
  const Trajectory trajectory = follow(made);
  outcome.set_points = trajectory.points.size();
  outcome.ending = trajectory.ending;
  if (is_repeated && follow(made).points != trajectory.points) {
    outcome.findings.push_back({"the same case gives other set points the second time"});
  }
  if (trajectory.ending == Ending::kRefused) {
    if (!is_lawful_refusal(trajectory.error)) {
      outcome.findings.push_back({"a sound program is refused: " + trajectory.error});
    }
    return outcome;
  }
  if (trajectory.ending == Ending::kNone) {
    outcome.findings.push_back({"the motion does not end"});
    return outcome;
  }
  if (trajectory.points.empty()) {
    outcome.findings.push_back({"a program that moves has no set points"});
    return outcome;
  }
  if (!std::all_of(trajectory.points.begin(), trajectory.points.end(),
                   [](const Vec3& point) { return point.allFinite(); })) {
    outcome.findings.push_back({"a set point that is not finite"});
    return outcome;
  }
  judge_ends(made, trajectory, outcome);
  measure_limits(made, trajectory, outcome.shares);
  measure_distance(made, trajectory, outcome.shares);
  measure_time(made, trajectory, outcome.shares);
  judge_shares(made, outcome);
  return outcome;
}

}  // namespace twin::fuzz
