#include "studies/identify/validation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/units.hpp"
#include "studies/identify/baselines.hpp"

namespace twin::studies::identify {
namespace {

using Signal = std::function<double(std::size_t)>;

/// Statistics of a difference over the rows that count.
results::ErrorStats statistics(const AxisRecord& record, std::size_t first, const Signal& error) {
  results::ErrorStats result;
  double sum = 0.0;
  double rows = 0.0;
  for (std::size_t k = first; k < record.measured.size(); ++k) {
    if (record.counts(k)) {
      const double e = error(k);
      sum += e * e;
      rows += 1.0;
      result.max = std::max(result.max, std::abs(e));
    }
  }
  result.rms = std::sqrt(sum / std::max(rows, 1.0));
  return result;
}

/// The force of the twin's motor: in torque mode that of its drive command.
double force_of(const AxisRow& row, const hal::mujoco::AxisParams& axis) {
  return axis.drive.mode == hal::mujoco::DriveMode::kTorque
             ? row.volts * axis.torque_per_volt() / units::m_from_mm(axis.mm_per_rad())
             : row.force;
}

void validate_positions(const AxisRecord& record, const AxisRun& run, std::size_t first,
                        double period, std::span<const AxisRecord> trained, Validation& result) {
  result.delay_time = fit_delay(trained, period);
  const std::vector<double> late = delayed_command(record, period, result.delay_time);
  const std::vector<double> filtered = filtered_command(record, fit_taps(trained));
  const auto against = [&](const auto& position) {
    return statistics(record, first,
                      [&](std::size_t k) { return record.measured[k] - position(k); });
  };
  const auto simulated = [&](std::size_t k) { return run.rows[k].feedback; };
  result.tracking = against([&](std::size_t k) { return record.command[k].position; });
  result.twin = against(simulated);
  result.delay = against([&](std::size_t k) { return late[k]; });
  result.filter = against([&](std::size_t k) { return filtered[k]; });
  for (std::size_t k = first; k < record.measured.size(); ++k) {
    const double y = record.measured[k];
    result.curves.push_back({static_cast<double>(k) * period, units::um_from_mm(y - simulated(k)),
                             units::um_from_mm(y - filtered[k]), units::um_from_mm(y - late[k])});
  }
}

}  // namespace

Validation validate(const AxisRecord& record, hal::Axis axis, const config::MachineFile& machine,
                    const std::optional<InverseModel>& inverse,
                    std::span<const AxisRecord> trained) {
  Validation result;
  result.trace = record.trace;
  result.axis = axis;
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const AxisRun run = follow_record(machine, axis, record);
  const std::size_t first = settling_rows(record, machine.period);
  validate_positions(record, run, first, machine.period, trained, result);
  if (record.has_volts()) {
    result.volts.emplace();
    result.volts->measured_rms =
        statistics(record, first, [&](std::size_t k) { return record.volts[k]; }).rms;
    result.volts->twin = statistics(
        record, first, [&](std::size_t k) { return record.volts[k] - run.rows[k].volts; });
  }
  if (record.has_force()) {
    result.force.emplace();
    result.force->measured_rms =
        statistics(record, first, [&](std::size_t k) { return record.force[k]; }).rms;
    result.force->twin = statistics(record, first, [&](std::size_t k) {
      return record.force[k] - force_of(run.rows[k], params);
    });
    if (inverse) {
      const double quantum = std::abs(params.encoder.mm_per_count);
      result.inverse_force_error = force_error(*inverse, {&record, 1}, machine.period, quantum);
      const InverseModel rigid =
          fit_inverse_model(trained, machine.period, quantum, Directions::kAlike);
      result.force->rigid_body_rms = force_error(rigid, {&record, 1}, machine.period, quantum);
    }
  }
  return result;
}

}  // namespace twin::studies::identify
