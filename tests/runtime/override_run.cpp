#include "tests/runtime/override_run.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "results/metrics/limit_audit.hpp"
#include "runtime/feed_control.hpp"
#include "tests/runtime/planned.hpp"

namespace twin::test {
namespace {

using runtime::FeedControl;

constexpr double kOffPath = 2e-5;     // chords in place of arcs [mm]
constexpr double kFinePeriod = 1e-4;  // [s]
constexpr double kExcess = 1.005;
constexpr int kPhases = 10;

double distance_to_chord(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double square = d.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0.0;
  return (p - a - share * d).norm();
}

results::AuditPeaks audit(const OverrideRun& run, const config::MachineFile& machine) {
  results::LimitAudit audit(machine.period, machine.limits);
  for (const results::Sample& sample : run.samples) {
    audit.add(sample.command);
  }
  return audit.finish();
}

void raise(const results::AuditPeaks& to, results::AuditPeaks& peaks) {
  for (const auto member :
       {&results::AuditPeaks::feedrate, &results::AuditPeaks::tangential_acceleration,
        &results::AuditPeaks::tangential_jerk, &results::AuditPeaks::normal_acceleration}) {
    peaks.*member = std::max(peaks.*member, to.*member);
  }
}

}  // namespace

OverrideRun run_with_overrides(const std::string& text, const config::MachineFile& machine,
                               const std::vector<runtime::OverrideChange>& schedule) {
  runtime::OperatorPanel panel;
  const double percent = runtime::first_override(schedule, panel);
  InlinePlan plan(text, machine, InlinePlan::Replans::kOnRequest, percent);
  motion::Interpolator interpolator(plan.planning, machine.period, machine.interpolation);
  const Limits& limits = machine.limits;
  FeedControl feed(interpolator, plan.planning, plan.planning, panel,
                   {.schedule = schedule,
                    .ramp = {limits.acceleration, limits.jerk},
                    .period = machine.period,
                    .first_percent = percent,
                    .feedrate = limits.feedrate});
  runtime::Cycle cycle(interpolator, nullptr, machine.servo, machine.period);
  runtime::SampleQueue samples(1 << 17);
  std::atomic<bool> stop{false};
  OverrideRun run;
  runtime::LockstepPace pace(plan.planning, stop);
  run.end = run_motion(cycle, interpolator, plan.planning, samples, pace,
                       {.period = machine.period, .limits = limits, .feed = &feed}, stop)
                .end;
  EXPECT_FALSE(plan.planning.error()) << to_string(*plan.planning.error());
  run.records = feed.records();
  results::Sample sample;
  while (samples.pop(sample)) {
    run.samples.push_back(sample);
  }
  return run;
}

PlainRun run_plain(const std::string& text, const config::MachineFile& machine) {
  PlainRun plain{run_with_overrides(text, machine, {}), {}, {}};
  for (int k = 0; k < kPhases; ++k) {
    const auto rest = fmt::format("G04 P{:.6f}\n", machine.period * k / kPhases);
    raise(audit(run_with_overrides(rest + text, machine, {}), machine), plain.peaks);
  }
  config::MachineFile fine = machine;
  fine.period = kFinePeriod;
  for (const results::Sample& sample : run_with_overrides(text, fine, {}).samples) {
    plain.path.push_back(sample.command);
  }
  return plain;
}

namespace {

void expect_limits_kept(const OverrideRun& run, const results::AuditPeaks& before,
                        const config::MachineFile& machine) {
  const results::AuditPeaks peaks = audit(run, machine);
  const Limits& limits = machine.limits;
  const auto allowed = [](double limit, double was) { return kExcess * std::max(limit, was); };
  EXPECT_LE(peaks.tangential_acceleration,
            allowed(limits.acceleration, before.tangential_acceleration));
  EXPECT_LE(peaks.tangential_jerk, allowed(limits.jerk, before.tangential_jerk));
  EXPECT_LE(peaks.normal_acceleration, allowed(limits.acceleration, before.normal_acceleration));
  EXPECT_LE(peaks.feedrate, limits.feedrate * (1.0 + 1e-9));
}

}  // namespace

void expect_same_path_within_limits(const OverrideRun& run, const PlainRun& plain,
                                    const config::MachineFile& machine) {
  ASSERT_EQ(run.end, runtime::MotionEnd::kDone);
  ASSERT_LT((run.samples.back().command - plain.path.back()).norm(), 1e-9);
  ASSERT_EQ(run.samples.back().feedrate, 0.0);
  expect_limits_kept(run, plain.peaks, machine);
  std::size_t at = 0;  // chord of the path
  for (const results::Sample& sample : run.samples) {
    const Vec3& p = sample.command;
    const std::size_t last = std::min(at + 5000, plain.path.size() - 1);
    std::size_t i = at;
    while (i < last && distance_to_chord(p, plain.path[i], plain.path[i + 1]) > kOffPath) {
      ++i;
    }
    ASSERT_LT(i, last) << "off the path or back on it: t = " << sample.t << " s, line "
                       << sample.line;
    at = i;
  }
}

}  // namespace twin::test
