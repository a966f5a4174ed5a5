#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "studies/identify/axis_model.hpp"
#include "studies/identify/recording.hpp"

namespace twin::studies::identify {

/// What a simulated machine's recording has besides command and measured position.
enum class Recorded { kPositions, kVolts, kVoltsAndForce };

inline constexpr double kGoesOn = 0.01;  // after the end of a recording [s]

/// Set points of strokes at several velocities, both ways, from rest [mm].
inline std::vector<double> strokes(double seconds, double period) {
  std::vector<double> positions;
  const auto hill = [](double t, double frequency) {
    const double s = std::sin(std::numbers::pi * frequency * t);
    return s * s;
  };
  for (double t = 0.0; t < seconds; t += period) {
    positions.push_back(30.0 * hill(t, 0.5) + 8.0 * hill(t, 1.7) - 2.0 * hill(t, 3.1));
  }
  return positions;
}

/// The recording that a machine's X axis leaves of these strokes; Y is not recorded.
inline Recording record_x(const config::MachineFile& machine, Recorded what, double seconds) {
  Recording recording;
  recording.file = "simulated.csv";
  recording.period = machine.period;
  AxisSignals& x = recording.axis[hal::kX];
  // The strokes go on when the recording ends.
  const std::vector<double> positions = strokes(seconds + kGoesOn, machine.period);
  AxisRun run = simulate(axis_setup(machine, hal::kX), differentiate(positions, machine.period));
  const auto rows = static_cast<std::size_t>(std::lround(seconds / machine.period));
  run.rows.resize(rows);
  x.command.assign(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(rows));
  const hal::Dac dac(machine.table.axis[hal::kX].dac_bits);
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    x.measured.push_back(run.rows[k].encoder);
    if (what != Recorded::kPositions) {
      x.volts.push_back(dac.convert(run.rows[k].volts));
    }
    if (what == Recorded::kVoltsAndForce) {
      x.force.push_back(run.rows[k].force);
    }
  }
  recording.rows = x.command.size();
  recording.has_moved[hal::kX] = true;
  return recording;
}

}  // namespace twin::studies::identify
