#pragma once

#include <filesystem>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "results/trace/decimator.hpp"

namespace twin::studies::compare {

/// A plan beside its lower bound, see feedrate::TimeBound.
struct BoundedPlan {
  double time_bound = 0.0;            ///< without a limit of jerk, as the profile `bound` [s]
  double time_bound_with_jerk = 0.0;  ///< [s]
  results::Table planned;             ///< columns s [mm], feedrate [mm/s], time without rests [s]
  results::Table bound;  ///< the same of the bound; more than one row at a place are possible
};

/// Whether bounded_plan() records the feedrate along the path. Else the tables stay empty.
enum class Profiles { kRecorded, kLeftOut };

/// Plans a program and bounds its time.
///
/// @param feedrate  replaces the program's F words [mm/s]
Expected<BoundedPlan> bounded_plan(const gcode::ProgramText& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate, Profiles profiles);

/// Time by which a plan is behind its bound, along the path.
///
/// Between two rows of a profile, v^2 is taken as linear over s, as it is at constant acceleration.
/// With x the share of the distance between the rows that is covered at s, this gives
///   t(s) = t_0 + (t_1 - t_0) x (v_0 + v_1) / (v_0 + v(s)).
///
/// @param pieces  equal lengths of path
/// @returns columns s [mm], lost time [s]
results::Table lost_time(const BoundedPlan& plan, std::size_t pieces);

/// As much of a profile as a picture needs. The path is divided into equal lengths; of each, the
/// feedrate at its begin and its least and greatest row are kept.
/// @returns columns s [mm], feedrate [mm/s]
results::Table thinned(const results::Table& profile, std::size_t pieces);

}  // namespace twin::studies::compare
