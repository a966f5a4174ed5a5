#include "studies/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>

#include "core/stop_wish.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/parallel_for.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kPoorPrediction = 0.2;    // of the RMS tracking error
constexpr double kPeriodTolerance = 1e-4;  // relative, between recordings

Expected<void> check_periods(const std::vector<Recording>& recordings) {
  for (const Recording& recording : recordings) {
    const double period = recordings.front().period;
    if (std::abs(recording.period - period) > kPeriodTolerance * period) {
      return tl::unexpected<Error>(
          Error{ErrorCode::kFile,
                fmt::format("rows are {:g} ms apart, but {:g} ms in {}: identify them one by one",
                            recording.period * 1e3, period * 1e3, recordings.front().file.string()),
                recording.file.string(), 0, 0});
    }
  }
  return {};
}

/// The records of one axis, of the recordings in which it moves.
std::vector<AxisRecord> records_of(const std::vector<Recording>& recordings, hal::Axis axis) {
  std::vector<AxisRecord> records;
  bool has_volts = true;
  for (const Recording& recording : recordings) {
    if (!recording.has_moved[axis]) {
      continue;
    }
    const AxisSignals& signals = recording.axis[axis];
    records.push_back(
        {differentiate(signals.command, recording.period), signals.measured, signals.volts});
    has_volts = has_volts && !signals.volts.empty();
  }
  if (!has_volts) {
    std::ranges::for_each(records, [](AxisRecord& record) { record.volts.clear(); });
  }
  return records;
}

/// Statistics of set point less measured position.
results::ErrorStats tracking_error(const std::vector<motion::Reference>& command,
                                   const std::function<double(std::size_t)>& measured) {
  results::ErrorStats result;
  double sum = 0.0;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const double error = command[k].position - measured(k);
    sum += error * error;
    result.max = std::max(result.max, std::abs(error));
  }
  result.rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(command.size(), 1)));
  return result;
}

/// Runs the identified machine along the commands of every recording.
std::vector<Prediction> predict(const std::vector<Recording>& recordings,
                                const config::MachineFile& machine) {
  std::vector<Prediction> result;
  for (const Recording& recording : recordings) {
    for (const hal::Axis axis : {hal::kX, hal::kY}) {
      if (recording.has_moved[axis]) {
        result.push_back({recording.file.string(), axis, {}, {}});
      }
    }
  }
  parallel_for(result.size(), [&](std::size_t i) {
    Prediction& prediction = result[i];
    const auto recording = std::ranges::find(recordings, prediction.trace,
                                             [](const Recording& r) { return r.file.string(); });
    const AxisSignals& signals = recording->axis[prediction.axis];
    const auto command = differentiate(signals.command, recording->period);
    AxisSetup setup = axis_setup(machine, prediction.axis);
    setup.axis.travel = kFarTravel;
    const std::vector<AxisRow> rows = simulate(setup, command).rows;
    prediction.measured =
        tracking_error(command, [&](std::size_t k) { return signals.measured[k]; });
    prediction.simulated = tracking_error(command, [&](std::size_t k) { return rows[k].encoder; });
  });
  return result;
}

/// Says of which traces the identified machine is no model.
void note_poor_predictions(Identification& result) {
  for (const Prediction& p : result.predictions) {
    const double ratio = p.simulated.rms / p.measured.rms;
    if (!(std::abs(ratio - 1.0) <= kPoorPrediction)) {
      result.notes.push_back(fmt::format(
          "{}: the identified machine does not fit {}: tracking error {:.3g} um RMS, measured "
          "{:.3g} um. Start from a machine file that is nearer (--machine, --set), or give the "
          "drive commands too",
          p.trace, p.axis == hal::kX ? "X" : "Y", 1e3 * p.simulated.rms, 1e3 * p.measured.rms));
    }
  }
}

/// Progress of two fits at a time as one.
class SharedProgress {
 public:
  SharedProgress(const std::function<void(double)>& show, std::size_t parts)
      : show_(show), parts_(parts) {}
  void set(std::size_t axis, double share) {
    const std::lock_guard lock(mutex_);
    share_[axis] = share;
    if (show_) {
      show_((share_[0] + share_[1]) / static_cast<double>(parts_));
    }
  }

 private:
  const std::function<void(double)>& show_;
  std::size_t parts_;
  std::array<double, hal::kServoAxes> share_{};
  std::mutex mutex_;
};

}  // namespace

Expected<Identification> identify(const std::vector<Recording>& recordings,
                                  const config::MachineFile& start, const FitOptions& options) {
  TWIN_CHECK(check_periods(recordings));
  Identification result;
  result.machine = start;
  result.machine.period = recordings.front().period;
  for (const Recording& recording : recordings) {
    result.notes.insert(result.notes.end(), recording.notes.begin(), recording.notes.end());
  }
  std::vector<hal::Axis> axes;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (std::ranges::any_of(recordings, [axis](const Recording& r) { return r.has_moved[axis]; })) {
      axes.push_back(axis);
    }
  }
  SharedProgress progress(options.progress, axes.size());
  parallel_for(axes.size(), [&](std::size_t i) {
    FitOptions of_axis = options;
    of_axis.progress = [&](double share) { progress.set(i, share); };
    result.axis[axes[i]] =
        fit_axis(AxisProblem(result.machine, axes[i], records_of(recordings, axes[i])), of_axis);
  });
  for (const hal::Axis axis : axes) {
    result.machine.table.axis[axis] = result.axis[axis]->machine.table.axis[axis];
    result.machine.servo[axis] = result.axis[axis]->machine.servo[axis];
  }
  TWIN_CHECK(check_wish(options.stop, "interrupted: nothing was written"));
  result.predictions = predict(recordings, result.machine);
  note_poor_predictions(result);
  return result;
}

}  // namespace twin::studies::identify
