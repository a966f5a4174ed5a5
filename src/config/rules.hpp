#pragma once

#include <set>
#include <string>

#include "config/machine_file.hpp"

namespace twin::config {

/// Checks what no single key can know: that ends of travel are in order and min_segments is at most
/// max_segments, that limits of single axes let the axes move, and that no line of the rig is used
/// twice.
///
/// What the table's settings say together (a whole number of physics steps in a period) the table
/// checks itself, for a plan does not need it. @returns kFile error with the keys and values that
/// do not fit
Expected<void> check_rules(const MachineFile& machine);

/// Decides which planner plans, once for everything downstream: machine.path.planner.
///
/// Bezier pieces and bare lines (path.curves), the acceleration profiles s_curve and fir, and the
/// feedrate rules that leave a limit out or exceed the programmed feedrate (constant,
/// contact_speed) are there to be compared with the paper, and only its planner has them. Where a
/// machine asks for the certified planner, which is the default, together with one of them, the
/// planner becomes the paper's and a note says so.
///
/// @param given  paths of the settings that were asked for by --set: where the certified planner
///               and what it does not have are both among them, that is an error
Expected<void> resolve_planner(MachineFile& machine, const std::set<std::string>& given = {});

}  // namespace twin::config
