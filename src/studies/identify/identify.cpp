#include "studies/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>
#include <numbers>

#include "core/parallel_for.hpp"
#include "core/stop_wish.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/signal_checks.hpp"

namespace twin::studies::identify {
namespace {

constexpr const char* kModelWithScrews = "xy_table_compliant.xml";
constexpr double kHeldOutShare = 0.3;      // of each recording
constexpr double kPoorPrediction = 0.2;    // of the RMS tracking error
constexpr double kPeriodTolerance = 1e-4;  // relative, between recordings

Expected<void> check_periods(const std::vector<Recording>& recordings, double period) {
  for (const Recording& recording : recordings) {
    if (std::abs(recording.period - period) > kPeriodTolerance * period) {
      return tl::unexpected<Error>(
          Error{ErrorCode::kFile,
                fmt::format("rows are {:g} ms apart, but {:g} ms in the first trace: identify them "
                            "one by one",
                            recording.period * 1e3, period * 1e3),
                recording.file.string(), 0, 0});
    }
  }
  return {};
}

/// Gives the machine screws that give where the table's position was recorded.
void give_screws_where_seen(const std::vector<Recording>& recordings, Identification& result) {
  hal::mujoco::TableParams& table = result.machine.table;
  bool is_seen = false;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const Recording& recording : recordings) {
      is_seen = is_seen || (recording.has_moved[axis] &&
                            (recording.is_at_table || !recording.axis[axis].scale.empty() ||
                             table.axis[axis].encoder.place == hal::mujoco::EncoderPlace::kTable));
    }
  }
  if (!is_seen || table.has_giving_screws()) {
    return;
  }
  table.model = std::filesystem::path(table.model).replace_filename(kModelWithScrews).string();
  result.notes.push_back(fmt::format(
      "the table's position was recorded: table.model is {}, whose screws give", kModelWithScrews));
}

/// The records of one axis, of the recordings in which it moves: those of the motor's encoder first.
std::vector<AxisRecord> records_of(const std::vector<Recording>& recordings, hal::Axis axis,
                                   const config::MachineFile& machine) {
  std::vector<AxisRecord> records;
  for (const Recording& recording : recordings) {
    if (recording.has_moved[axis]) {
      records.push_back(axis_record(recording, axis, machine));
    }
  }
  std::ranges::stable_partition(records, std::logical_not(), &AxisRecord::is_at_table);
  if (!std::ranges::all_of(records, &AxisRecord::has_volts)) {
    std::ranges::for_each(records, [](AxisRecord& record) { record.volts.clear(); });
  }
  if (!std::ranges::all_of(records, &AxisRecord::has_force)) {
    std::ranges::for_each(records, [](AxisRecord& record) { record.force.clear(); });
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

void turn_force(AxisRecord& record) {
  std::ranges::for_each(record.force, [](double& force) { force = -force; });
}

using Records = std::array<std::vector<AxisRecord>, hal::kServoAxes>;

/// Runs the identified machine along the commands of every record.
std::vector<Prediction> predict(const Records& records, const config::MachineFile& machine) {
  std::vector<Prediction> result;
  std::vector<const AxisRecord*> sources;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const AxisRecord& record : records[axis]) {
      result.push_back({record.trace, axis, {}, {}});
      sources.push_back(&record);
    }
  }
  parallel_for(result.size(), [&](std::size_t i) {
    Prediction& prediction = result[i];
    const AxisRecord& record = *sources[i];
    const std::vector<AxisRow> rows = follow_record(machine, prediction.axis, record).rows;
    prediction.measured =
        tracking_error(record.command, [&](std::size_t k) { return record.measured[k]; });
    prediction.simulated =
        tracking_error(record.command, [&](std::size_t k) { return rows[k].encoder; });
  });
  return result;
}

/// A machine whose hum has come as far as it is where a part of a record begins.
config::MachineFile with_hum_at(config::MachineFile machine, hal::Axis axis, double seconds) {
  hal::mujoco::DriveParams& drive = machine.table.axis[axis].drive;
  drive.hum_phase += 2.0 * std::numbers::pi * drive.hum_frequency_Hz * seconds;
  return machine;
}

/// A machine without hum: where its phase is not known, a hum predicts nothing.
config::MachineFile without_hum(config::MachineFile machine, hal::Axis axis) {
  machine.table.axis[axis].drive.hum_amplitude = 0.0;
  return machine;
}

/// Predicts the ends of the records by the machines that their begins were fitted by.
void validate_held_out(const Records& records, double share, Identification& result) {
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const auto& fit = result.axis[axis];
    if (!fit || !fit->trained) {
      continue;
    }
    const double period = result.machine.period;
    std::vector<AxisRecord> trained;
    for (const AxisRecord& record : records[axis]) {
      trained.push_back(part_of(record, 0, trained_rows(record, share), period));
    }
    for (std::size_t i = 0; i < trained.size(); ++i) {
      const AxisRecord& whole = records[axis][i];
      const std::size_t first = trained[i].measured.size();
      const AxisRecord rest = part_of(whole, first, whole.measured.size() - first, period);
      if (!moves_enough(rest)) {
        continue;
      }
      const double passed = static_cast<double>(first) * period + (whole.begin ? 0.0 : kSettleTime);
      const config::MachineFile machine =
          i == 0 ? with_hum_at(*fit->trained, axis, passed) : without_hum(*fit->trained, axis);
      Validation& validation = result.validations.emplace_back(
          validate(rest, axis, machine, fit->trained_inverse, trained));
      validation.is_held_out = true;
      validation.first_row = first;
    }
  }
}

/// Predicts recordings that were not fitted.
Expected<void> validate_recordings(const std::vector<Recording>& recordings,
                                   const config::MachineFile& units, const Records& trained,
                                   Identification& result) {
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    std::vector<AxisRecord> records = records_of(recordings, axis, units);
    for (AxisRecord& record : records) {
      if (result.axis[axis] && result.axis[axis]->turns_force) {
        turn_force(record);
      }
      if (!result.axis[axis]) {
        result.notes.push_back(fmt::format("{}: {} moves, but was not identified; not validated",
                                           record.trace, axis == hal::kX ? "X" : "Y"));
        continue;
      }
      result.validations.push_back(validate(record, axis, without_hum(result.machine, axis),
                                            result.axis[axis]->used_inverse(), trained[axis]));
    }
  }
  if (!recordings.empty() && result.validations.empty()) {
    return tl::unexpected<Error>(Error{ErrorCode::kFile,
                                       "nothing moves here that was identified: no validation",
                                       recordings.front().file.string(), 0, 0});
  }
  return {};
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
                                  const config::MachineFile& start, const FitOptions& options,
                                  const std::vector<Recording>& validating) {
  TWIN_CHECK(check_periods(recordings, recordings.front().period));
  TWIN_CHECK(check_periods(validating, recordings.front().period));
  Identification result;
  result.machine = start;
  result.machine.period = recordings.front().period;
  for (const auto* const list : {&recordings, &validating}) {
    for (const Recording& recording : *list) {
      std::ranges::copy(recording.notes, std::back_inserter(result.notes));
    }
  }
  give_screws_where_seen(recordings, result);
  Records records;
  std::vector<hal::Axis> axes;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (std::ranges::any_of(recordings, [axis](const Recording& r) { return r.has_moved[axis]; })) {
      TWIN_CHECK(fit_units(recordings, axis, result));
      axes.push_back(axis);
    }
  }
  const config::MachineFile units = result.machine;
  for (const hal::Axis axis : axes) {
    records[axis] = records_of(recordings, axis, units);
    TWIN_CHECK(check_signals(records[axis], axis, units));
  }
  const double held_out = validating.empty() ? kHeldOutShare : 0.0;
  SharedProgress progress(options.progress, axes.size());
  parallel_for(axes.size(), [&](std::size_t i) {
    FitOptions of_axis = options;
    of_axis.held_out_share = held_out;
    of_axis.progress = [&](double share) { progress.set(i, share); };
    result.axis[axes[i]] = fit_axis(AxisProblem(units, axes[i], records[axes[i]]), of_axis);
  });
  for (const hal::Axis axis : axes) {
    const AxisFit& fit = *result.axis[axis];
    if (fit.turns_force) {
      std::ranges::for_each(records[axis], turn_force);
    }
    result.machine.table.axis[axis] = fit.machine.table.axis[axis];
    if (std::ranges::all_of(records[axis], &AxisRecord::is_at_table)) {
      result.machine.table.axis[axis].encoder.place = hal::mujoco::EncoderPlace::kTable;
    }
    result.machine.servo[axis] = fit.machine.servo[axis];
    for (const std::string& note : fit.notes) {
      result.notes.push_back(fmt::format("{}: {}", axis == hal::kX ? "X" : "Y", note));
    }
  }
  TWIN_CHECK(check_wish(options.stop, "interrupted: nothing was written"));
  result.predictions = predict(records, result.machine);
  validate_held_out(records, held_out, result);
  TWIN_CHECK(validate_recordings(validating, units, records, result));
  note_poor_predictions(result);
  return result;
}

}  // namespace twin::studies::identify
