#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "core/vec.hpp"
#include "motion/interpolator/set_point.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::studies::compensate {

/// What nobody knows of a machine before it runs: where in a count the encoders begin, and where in
/// its period the mains hum is.
struct Phases {
  std::array<double, 2> encoder{0.5, 0.5};  ///< [counts]
  std::array<double, 2> hum{0.0, 0.0};      ///< [rad]
};

/// Phases number `index` of `count` that fill their ranges evenly, each axis and each phase in an
/// order of its own.
///
/// @param shift  0 to 1, moves all of them, so that two sets with other shifts share none
Phases even_phases(std::size_t index, std::size_t count, double shift);

/// References of one axis: set points with offsets added, and what they add to velocity and
/// acceleration.
///
/// The velocity of the offsets is (o_(k+1) - o_(k-1)) / 2T and their acceleration
/// (o_(k+1) - 2 o_k + o_(k-1)) / T^2, as motion::CorrectionFollower has them. Before the first and
/// after the last set point the offset does not change.
/// @param offsets  as many as set points, or none [mm]
/// @param axis     0 for x, 1 for y
std::vector<motion::Reference> corrected_references(std::span<const motion::SetPoint> points,
                                                    std::span<const Vec2> offsets, std::size_t axis,
                                                    double period);

/// Where the machine was in each period.
struct ModelRun {
  std::vector<Vec2> table;    ///< true position [mm]
  std::vector<Vec2> encoder;  ///< what the counts mean [mm]
  bool has_failed = false;    ///< a loop became unstable
};

/// Runs set points with offsets on the model that a machine file describes.
ModelRun run_model(const config::MachineFile& machine, std::span<const motion::SetPoint> points,
                   std::span<const Vec2> offsets, const Phases& phases);

/// The mean of several runs with even phases: what belongs to the machine, not to a phase. Uses all
/// cores; the result does not depend on their number.
///
/// @param runs  how many, at least 1
ModelRun mean_run(const config::MachineFile& machine, std::span<const motion::SetPoint> points,
                  std::span<const Vec2> offsets, std::size_t runs, double shift = 0.0);

}  // namespace twin::studies::compensate
