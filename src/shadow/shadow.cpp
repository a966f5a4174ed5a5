#include "shadow/shadow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/stop_wish.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::shadow {
namespace {

constexpr std::array<const char*, hal::kServoAxes> kAxisNames{"x", "y"};
constexpr std::array<hal::Axis, hal::kServoAxes> kAxes{hal::kX, hal::kY};

/// Series of the channels of one axis over a track.
std::vector<ChannelSeries> series_of(AxisObserver observer, const Track& track, hal::Axis axis) {
  std::vector<ChannelSeries> series(observer.channels().size());
  for (const ShadowSample& sample : track.samples) {
    const Observation seen = observer.step(sample.axis[axis]);
    for (std::size_t i = 0; i < series.size(); ++i) {
      series[i].rows.push_back(seen.row[i]);
      series[i].counts.push_back(seen.counts);
      series[i].moves.push_back(seen.moves[i] ? 1 : 0);
      series[i].direction.push_back(seen.direction);
      series[i].heading.push_back(seen.heading);
      series[i].is_slow.push_back(seen.is_slow ? 1 : 0);
    }
  }
  return series;
}

/// Whether a channel knows its parameters better than another one, in the geometric mean.
bool is_sharper(const PerParameter& one, const PerParameter& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kParameters; ++i) {
    sum += one[i] > 0.0 && other[i] > 0.0 ? std::log(one[i] / other[i]) : 0.0;
  }
  return sum > 0.0;
}

/// Learns the channels of one axis.
Expected<std::vector<ChannelBaseline>> learn_axis(const config::MachineFile& machine,
                                                  const std::vector<Track>& tracks, hal::Axis axis,
                                                  bool gives, const std::atomic<bool>* stop) {
  std::vector<std::vector<ChannelSeries>> by_channel;
  std::vector<ChannelKind> kinds;
  std::vector<ChannelFacts> facts;
  for (const Track& track : tracks) {
    if (!track.is_recorded[axis]) {
      continue;
    }
    const AxisObserver observer(machine, axis, gives, track.recorded[axis]);
    if (kinds.empty()) {
      kinds = observer.channels();
      by_channel.resize(kinds.size());
      for (std::size_t i = 0; i < kinds.size(); ++i) {
        facts.push_back(observer.facts(i));
      }
    } else if (kinds != observer.channels()) {
      return fail(ErrorCode::kFile, fmt::format("{}: other signals are recorded than in {}",
                                                track.name, tracks.front().name));
    }
    TWIN_CHECK(check_wish(stop, "interrupted: nothing is learnt"));
    std::vector<ChannelSeries> series = series_of(observer, track, axis);
    for (std::size_t i = 0; i < series.size(); ++i) {
      by_channel[i].push_back(std::move(series[i]));
    }
  }
  std::vector<ChannelBaseline> learnt;
  std::optional<Error> why;
  std::optional<PerParameter> of_position;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    PerParameter precision{};
    auto channel = learn_channel(kinds[i], by_channel[i], loosely_known(machine.table.axis[axis]),
                                 plausible(machine.table.axis[axis]), facts[i], &precision, stop);
    if (channel) {
      // Of the two views of the position the sharper one is kept.
      if (kinds[i] == ChannelKind::kCounts && of_position) {
        if (is_sharper(*of_position, precision)) {
          continue;
        }
        learnt.pop_back();
      }
      if (kinds[i] == ChannelKind::kPosition) {
        of_position = precision;
      }
      learnt.push_back(*std::move(channel));
    } else {
      why = channel.error();
    }
  }
  if (learnt.empty() && why) {
    return tl::unexpected(*why);
  }
  return learnt;
}

}  // namespace

Shadow::Shadow(const config::MachineFile& machine, const Baseline& baseline, bool gives,
               double hours, const std::array<Recorded, hal::kServoAxes>& recorded) {
  for (const hal::Axis axis : kAxes) {
    if (!baseline.axis[axis].empty()) {
      axes_[axis].emplace(AxisObserver(machine, axis, gives, recorded[axis]), baseline.axis[axis],
                          machine.period, hours);
    }
  }
}

bool Shadow::step(const ShadowSample& sample) {
  bool is_new = false;
  for (const hal::Axis axis : kAxes) {
    if (axes_[axis]) {
      is_new = axes_[axis]->step(sample.axis[axis], sample.time, sample.line) || is_new;
    }
  }
  return is_new;
}

bool Shadow::has_failed() const noexcept {
  return std::ranges::any_of(axes_, [](const auto& axis) { return axis && axis->has_failed(); });
}

Expected<Baseline> learn(const config::MachineFile& machine, const std::vector<Track>& tracks,
                         bool gives, const std::atomic<bool>* stop) {
  Baseline baseline;
  baseline.period = machine.period;
  baseline.machine = machine.name;
  baseline.machine_sha256 = hash_of_model(machine);
  std::optional<Error> why;
  for (const hal::Axis axis : kAxes) {
    auto learnt = learn_axis(machine, tracks, axis, gives, stop);
    if (learnt) {
      baseline.axis[axis] = *std::move(learnt);
    } else {
      why = learnt.error();
      TWIN_CHECK(check_wish(stop, why->message.c_str()));
      why->message = fmt::format("axis {}: {}", kAxisNames[axis], why->message);
    }
  }
  if (baseline.axis[hal::kX].empty() && baseline.axis[hal::kY].empty()) {
    return tl::unexpected(why.value_or(Error{ErrorCode::kFile, "nothing to learn from", {}, 0, 0}));
  }
  for (const Track& track : tracks) {
    baseline.programs.push_back(track.name);
    baseline.seconds += static_cast<double>(track.samples.size()) * machine.period;
  }
  return baseline;
}

Expected<void> check_identified(const config::MachineFile& machine) {
  if (!machine.table.is_identified) {
    return fail(ErrorCode::kMachine,
                fmt::format("table.identified is false in {}: a shadow needs a model that was "
                            "identified; twin identify writes a machine file of one",
                            machine.file.empty() ? machine.name : machine.file.string()));
  }
  return {};
}

Expected<void> check_signals(const Baseline& baseline, const Track& track,
                             const config::MachineFile& machine) {
  for (const hal::Axis axis : kAxes) {
    if (baseline.axis[axis].empty()) {
      continue;
    }
    const auto wrong = [&](const std::string& what) {
      return fail(ErrorCode::kFile,
                  fmt::format("{}: axis {} {}", track.name, kAxisNames[axis], what));
    };
    if (!track.is_recorded[axis]) {
      return wrong("is not recorded, and what was learnt has it");
    }
    const AxisObserver observer(machine, axis, false, track.recorded[axis]);
    const auto has = [&observer](const ChannelBaseline& channel) {
      return std::ranges::count(observer.channels(), channel.kind) > 0;
    };
    if (!std::ranges::all_of(baseline.axis[axis], has)) {
      return wrong(
          "has other signals than those that were learnt with: drive command, force and "
          "scale must be the same");
    }
  }
  return {};
}

std::string to_text(const Baseline& baseline, const config::MachineFile& machine) {
  std::string text;
  const double block = static_cast<double>(Evidence::kBlock) * baseline.period;
  for (const hal::Axis axis : kAxes) {
    for (const ChannelBaseline& channel : baseline.axis[axis]) {
      text +=
          fmt::format("axis {}, {}: noise {:.3g} {}, {} windows, threshold {:.0f}\n",
                      kAxisNames[axis], name_of(channel.kind),
                      is_followed(channel.kind) ? channel.noise.white : std::sqrt(channel.variance),
                      channel.kind == ChannelKind::kForce ? "N" : "um", channel.windows,
                      threshold_of(machine.shadow.hours, block, channel.windows));
    }
  }
  return text;
}

std::string to_line(const Finding& finding, hal::Axis axis) {
  const Hypothesis& cause = finding.cause;
  std::string text =
      fmt::format("axis {}: {} {}, since {:.2f} s", kAxisNames[axis], words_of(cause.cause),
                  amount_of(cause.cause, cause.change, cause.deviation), cause.since.time);
  if (cause.since.line > 0) {
    text += fmt::format(", line {}", cause.since.line);
  }
  text += fmt::format("; seen at {:.2f} s", finding.found.time);
  for (std::size_t i = 0; i < finding.or_else.size(); ++i) {
    text += fmt::format("{} {}", i == 0 ? "; cannot be told from a change of:" : ",",
                        words_of(finding.or_else[i]));
  }
  return text;
}

}  // namespace twin::shadow
