// Prints the tables of docs/shadow.md.
//
// TWIN_SHADOW_COUNTS=1: with shadow.counts = true.
//
//   shadow_table changes [STARTS] [WORDS]   what is found of each change, for so many begins
//   shadow_table healthy [RUNS]     healthy runs of ten programs at three feedrates
//   shadow_table seen               deviation of each parameter after 2 s of motion
//   shadow_table show               what was learnt

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "core/parallel_for.hpp"
#include "shadow_runs.hpp"

namespace twin::shadow {
namespace {

const std::vector<std::string> kPrograms{"butterfly", "butterfly_nurbs", "circle", "dolphin",
                                         "gear",      "mixed",           "oxalis", "square",
                                         "star",      "zigzag"};
constexpr double kHours = 1000.0;
constexpr std::array<double, 3> kFeedrates{1000.0, 3000.0, 6000.0};

/// One healthy run of each program at each feedrate, with phases that no run of the tables has.
Baseline learnt(const config::MachineFile& machine, bool gives) {
  std::vector<Track> tracks(kPrograms.size() * kFeedrates.size());
  parallel_for(tracks.size(), [&](std::size_t i) {
    tracks[i] = record(machine, {.program = kPrograms[i % kPrograms.size()],
                                 .feedrate_mm_per_min = kFeedrates[i / kPrograms.size()],
                                 .seed = 1000 + static_cast<unsigned>(i)});
  });
  return checked(learn(machine, tracks, gives));
}

void show(const Baseline& baseline, const config::MachineFile& machine) {
  fmt::print("{}", to_text(baseline, machine));
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    for (const ChannelBaseline& c : baseline.axis[axis]) {
      fmt::print(
          "{} {}: lost counts {:.2f}, force {:.2f}; walk {:.3g} um, white {:.3g} um, slow {:.3g} "
          "um\n",
          axis == 0 ? "x" : "y", name_of(c.kind), c.step_excess, c.force_excess, c.noise.walk,
          c.noise.white, c.noise.slow);
      for (std::size_t i = 0; i < kParameters; ++i) {
        fmt::print("  {:12} mean {:10.3g}  excess {:5.2f}  scatter {:.3g}\n",
                   name_of(static_cast<Cause>(i)), c.mean[i], c.excess[i], c.scatter[i]);
      }
    }
  }
}

/// What a shadow made of a change.
struct Outcome {
  bool was_early = false;  // found before anything had changed
  std::optional<Finding> found;
  std::string last;
  double noticed = 0.0;  // motion of the axis from the change until it was noticed [s]
  double delay = 0.0;    // and until it was named [s]
  bool other_axis = false;
};

Outcome watch(const config::MachineFile& machine, const Baseline& baseline, bool gives,
              const RunPlan& plan, hal::Axis axis, double start) {
  const Track track = record(machine, plan);
  Shadow shadow(machine, baseline, gives, kHours, track.recorded);
  double moved_before = 0.0;
  for (const ShadowSample& sample : track.samples) {
    shadow.step(sample);
    if (sample.time <= start) {
      moved_before = shadow.axis(axis)->motion();
    }
  }
  Outcome outcome;
  const AxisShadow& one = *shadow.axis(axis);
  outcome.found = one.finding();
  outcome.other_axis = shadow.axis(axis == hal::kX ? hal::kY : hal::kX)->finding().has_value();
  if (outcome.found) {
    outcome.was_early = outcome.found->noticed.time < start;
    outcome.noticed = outcome.found->noticed.moving - moved_before;
    outcome.delay = outcome.found->found.moving - moved_before;
    outcome.last = to_line(*one.last_finding(), axis);
  }
  return outcome;
}

struct Case {
  const char* words;
  const char* change;  // with the axis left out
  Cause cause;
  bool gives;
  bool has_scale;
};

const std::vector<Case> kCases{
    {"friction +30 %", "friction:{}=1.3@{}", Cause::kFriction, false, false},
    {"V-REF gain -5 %", "vref_gain:{}=0.95@{}", Cause::kVrefGain, false, false},
    {"one edge of 1,000 lost", "encoder_slip:{}=1@{}", Cause::kEncoder, false, false},
    {"backlash 5 um", "backlash:{}=5@{}", Cause::kBacklash, true, false},
    {"screw stiffness halved", "stiffness:{}=0.5@{}", Cause::kStiffness, true, false},
    {"the same, scale of 0.1 um", "stiffness:{}=0.5@{}", Cause::kStiffness, true, true},
    {"velocity loop -20 %", "loop_gain:{}=0.8@{}", Cause::kLoopGain, false, false},
    {"V-REF offset +5 mV", "vref_offset:{}=5@{}", Cause::kOffset, false, false},
    {"load +3 kg", "load:{}=3@{}", Cause::kInertia, false, false},
    {"force +4 N", "force:{}=4@{}", Cause::kForce, false, false},
    {"friction +50 % over 4 s", "friction:{}=1.5@{}+4", Cause::kFriction, false, false},
};

/// The drive is ready 20 ms after it is switched on, and the run moves 0.3 s after that [s].
constexpr double kReadyBeforeMotion = 0.3 - 0.02;

void print_case(const Case& one, hal::Axis axis, const std::vector<Outcome>& outcomes) {
  int found = 0;
  int right = 0;
  int alone = 0;
  int within = 0;
  int wrong_axis = 0;
  std::vector<double> delays;
  std::vector<double> noticed;
  std::string example;
  for (const Outcome& outcome : outcomes) {
    wrong_axis += outcome.other_axis ? 1 : 0;
    if (!outcome.found || outcome.was_early) {
      continue;
    }
    ++found;
    const bool is_named = outcome.found->cause.cause == one.cause;
    const bool is_among = is_named || std::ranges::count(outcome.found->or_else, one.cause) > 0;
    if (!is_named) {
      fmt::print(stderr, "not named: {}\n", to_line(*outcome.found, axis));
    }
    right += is_named ? 1 : 0;
    alone += is_among && !is_named ? 1 : 0;
    within += is_named && outcome.delay <= 2.0 ? 1 : 0;
    delays.push_back(outcome.delay);
    noticed.push_back(outcome.noticed);
    example = outcome.last;
  }
  const auto text_of = [](std::vector<double> times) {
    std::ranges::sort(times);
    return times.empty() ? "-"
                         : fmt::format("{:.2f} / {:.2f}", times[times.size() / 2], times.back());
  };
  fmt::print("| {} | {} | {} of {} | {} | {} ({}) | {} | {} | {} | {} |\n", one.words,
             axis == hal::kX ? "x" : "y", found, outcomes.size(), text_of(noticed), right, alone,
             text_of(delays), within, wrong_axis, example);
  std::fflush(stdout);
}

void print_changes(std::size_t starts, const std::string& only) {
  fmt::print(
      "| change | axis | noticed | after, median / largest, s | named (among others) | after, s | "
      "within 2 s | false on the other axis | at the end of one run |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::optional<config::MachineFile> machine;
  Baseline baseline;
  for (const Case& one : kCases) {
    if (std::string(one.words).find(only) == std::string::npos) {
      continue;
    }
    if (!machine || one.gives != (machine->table.model != table_machine().table.model) ||
        one.has_scale != machine->shadow.has_scale) {
      machine = table_machine(one.gives);
      machine->shadow.has_scale = one.has_scale;
      baseline = learnt(*machine, one.gives);
    }
    for (const hal::Axis axis : {hal::kX, hal::kY}) {
      std::vector<Outcome> outcomes(starts);
      parallel_for(starts, [&](std::size_t i) {
        const double start = 1.5 + 4.0 * static_cast<double>(i) / static_cast<double>(starts);
        const std::string change = fmt::format(
            fmt::runtime(one.change), axis == hal::kX ? "x" : "y", start + kReadyBeforeMotion);
        outcomes[i] = watch(
            *machine, baseline, one.gives,
            {.program = "dolphin", .seed = static_cast<unsigned>(100 + i), .changes = {change}},
            axis, start);
      });
      print_case(one, axis, outcomes);
    }
  }
}

void print_healthy(std::size_t runs) {
  const auto machine = table_machine();
  const Baseline baseline = learnt(machine, false);
  show(baseline, machine);
  std::mutex mutex;
  std::size_t alarms = 0;
  double motion = 0.0;
  double highest = 0.0;
  parallel_for(runs, [&](std::size_t i) {
    const RunPlan plan{.program = kPrograms[i % kPrograms.size()],
                       .feedrate_mm_per_min = kFeedrates[i / kPrograms.size() % kFeedrates.size()],
                       .seed = static_cast<unsigned>(i)};
    const Track track = record(machine, plan);
    Shadow shadow(machine, baseline, false, kHours, track.recorded);
    for (const ShadowSample& sample : track.samples) {
      shadow.step(sample);
    }
    const std::scoped_lock lock(mutex);
    for (const hal::Axis axis : {hal::kX, hal::kY}) {
      const AxisShadow& one = *shadow.axis(axis);
      motion += one.motion();
      for (const StripPoint& point : one.strip()) {
        highest = std::max(highest, point.level);
      }
      if (one.finding()) {
        ++alarms;
        fmt::print("{} F{} seed {}: {}\n", plan.program, plan.feedrate_mm_per_min, plan.seed,
                   to_line(*one.finding(), axis));
      }
    }
  });
  fmt::print(
      "{} healthy runs, {:.0f} s of motion of an axis: {} false alarms, at most {:.0f} % of "
      "the threshold\n",
      runs, motion, alarms, 100.0 * highest);
}

/// Deviations of all parameters by themselves, after 2 s of dolphin's motion.
void print_seen() {
  for (const bool gives : {false, true}) {
    const auto machine = table_machine(gives);
    const Baseline baseline = learnt(machine, gives);
    const Track track = record(machine, {.program = "dolphin", .seed = 7});
    Shadow shadow(machine, baseline, gives, kHours, track.recorded);
    for (const ShadowSample& sample : track.samples) {
      shadow.step(sample);
    }
    for (const hal::Axis axis : {hal::kX, hal::kY}) {
      const AxisShadow& one = *shadow.axis(axis);
      for (const AxisShadow::Estimate& e : one.estimates()) {
        fmt::print("{} {} {}: {}\n", gives ? "screws that give" : "rigid screws",
                   axis == hal::kX ? "x" : "y", name_of(e.cause),
                   amount_of(e.cause, 0.0, e.deviation * std::sqrt(one.motion() / 2.0)));
      }
    }
  }
}

}  // namespace
}  // namespace twin::shadow

int main(int argc, char** argv) {
  using namespace twin::shadow;
  const std::string what = argc > 1 ? argv[1] : "changes";
  const auto number = static_cast<std::size_t>(argc > 2 ? std::atoi(argv[2]) : 0);
  if (what == "healthy") {
    print_healthy(number > 0 ? number : 200);
  } else if (what == "seen") {
    print_seen();
  } else if (what == "show") {
    const auto machine = table_machine();
    show(learnt(machine, false), machine);
  } else {
    print_changes(number > 0 ? number : 10, argc > 3 ? argv[3] : "");
  }
}
