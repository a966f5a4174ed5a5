#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "hal/machine.hpp"
#include "motion/servo/axis_servo.hpp"
#include "tests/support/motions.hpp"

namespace twin::test {

/// One period of a closed loop [mm].
struct Row {
  std::array<double, 2> command{};
  std::array<double, 2> encoder{};
  std::array<double, 2> table{};
  bool operator==(const Row&) const = default;
};

inline motion::Gains gains(double kp, double kf, double ka) {
  motion::Gains g;
  g.kp = kp;
  g.kf = kf;
  g.ka = ka;
  return g;
}

/// Gains of mjcf/xy_table.toml.
inline std::array<motion::Gains, 2> default_gains() {
  return {gains(150.0, 1.003, 2.3e-3), gains(150.0, 1.008, 2.4e-3)};
}

/// Configures and activates a machine, holds it for 0.3 s, then moves it for some time.
/// @param motion set point at a time since the start [s]
inline std::vector<Row> run_loop(hal::Machine& machine, const std::array<motion::Gains, 2>& g,
                                 double period, double duration,
                                 const std::function<PlanePoint(double)>& motion) {
  if (auto result = checked(machine.configure(period)); !result) {
    throw std::runtime_error(to_string(result.error()));
  }
  if (auto result = checked(machine.activate()); !result) {
    throw std::runtime_error(to_string(result.error()));
  }
  const hal::MachineInfo& info = machine.info();
  std::array<motion::AxisServo, 2> servos{
      motion::AxisServo(g[0], info.mm_per_s_per_volt[0], period),
      motion::AxisServo(g[1], info.mm_per_s_per_volt[1], period)};
  const int hold = static_cast<int>(std::lround(0.3 / period));
  const int periods = static_cast<int>(std::lround(duration / period));
  std::vector<Row> rows;
  hal::Inputs inputs;
  hal::Outputs outputs;
  outputs.servo_on = {true, true};
  for (int k = -hold; k < periods; ++k) {
    if (machine.read(inputs) != hal::Status::kOk) {
      throw std::runtime_error(machine.last_error());
    }
    const PlanePoint point = motion(k < 0 ? 0.0 : k * period);
    Row row;
    for (std::size_t a = 0; a < 2; ++a) {
      row.command[a] = point.position[a];
      row.encoder[a] = motion::position_from_counts(inputs.counts[a], info.mm_per_count[a]);
      outputs.volts[a] = servos[a].update(
          {point.position[a], point.velocity[a], point.acceleration[a]}, row.encoder[a]);
      outputs.position_reference[a] = point.position[a];
    }
    if (machine.write(outputs) != hal::Status::kOk) {
      throw std::runtime_error(machine.last_error());
    }
    row.table = machine.truth().table_position;
    if (info.follows_reference) {
      row.encoder = row.table;
    }
    if (k >= 0) {
      rows.push_back(row);
    }
  }
  machine.deactivate();
  return rows;
}

struct Spread {
  double rms = 0.0;
  double max = 0.0;
};

/// Root mean square and largest of a quantity over rows from `first` on.
inline Spread spread(const std::vector<Row>& rows, std::size_t first,
                     const std::function<double(const Row&)>& quantity) {
  Spread result;
  for (std::size_t i = first; i < rows.size(); ++i) {
    const double value = quantity(rows[i]);
    result.rms += value * value;
    result.max = std::max(result.max, std::abs(value));
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(rows.size() - first));
  return result;
}

/// Radial error of the measured point against the circle of on_circle() [mm].
inline double circle_error(const Row& row, double radius) {
  return std::hypot(row.encoder[0] + radius, row.encoder[1]) - radius;
}

}  // namespace twin::test
