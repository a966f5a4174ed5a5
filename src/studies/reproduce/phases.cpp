#include "studies/reproduce/phases.hpp"

#include <cmath>
#include <numbers>

namespace twin::studies::reproduce {
namespace {

constexpr double kG = 1.2207440846057596;  // g^4 = g + 1

double fraction(double x) { return x - std::floor(x); }

}  // namespace

hal::mujoco::TableParams with_phases_of_repeat(hal::mujoco::TableParams table, int repeat) {
  double step = 1.0;
  for (hal::mujoco::AxisParams& axis : table.axis) {
    step /= kG;
    axis.encoder.phase = fraction(axis.encoder.phase + repeat * step);
  }
  step /= kG;
  constexpr double kCycle = 2.0 * std::numbers::pi;
  for (hal::mujoco::AxisParams& axis : table.axis) {
    axis.drive.hum_phase = kCycle * fraction(axis.drive.hum_phase / kCycle + repeat * step);
  }
  return table;
}

}  // namespace twin::studies::reproduce
