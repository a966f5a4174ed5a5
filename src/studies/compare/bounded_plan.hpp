#pragma once

#include <filesystem>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "results/trace/decimator.hpp"

namespace twin::studies::compare {

/// A plan beside its lower bound, see feedrate::TimeBound.
struct BoundedPlan {
  double time_bound = 0.0;  ///< [s]
  double deviation = 0.0;   ///< largest Segment::deviation; 0 where the planner gives none [mm]
  results::Table planned;   ///< columns s [mm], feedrate [mm/s], time without rests [s]
  results::Table bound;     ///< the same of the bound; more than one row at a place are possible
};

/// Plans a program and bounds its time.
///
/// @param feedrate       replaces the program's F words [mm/s]
/// @param has_profiles   else the tables stay empty
Expected<BoundedPlan> bounded_plan(const std::filesystem::path& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate, bool has_profiles);

/// Time by which a plan is behind its bound, along the path.
///
/// Between two rows of a profile v^2 is taken as linear over s, as it is where the acceleration is
/// constant: with x the share of the way between them,
///   t(s) = t_0 + (t_1 - t_0) x (v_0 + v_1) / (v_0 + v(s)).
///
/// @param pieces  equal lengths of path
/// @returns columns s [mm], lost time [s]
results::Table lost_time(const BoundedPlan& plan, std::size_t pieces);

/// As much of a profile as a picture needs: of each of a number of equal lengths the feedrate at
/// its begin and the least and the greatest of its rows.
/// @returns columns s [mm], feedrate [mm/s]
results::Table thinned(const results::Table& profile, std::size_t pieces);

}  // namespace twin::studies::compare
