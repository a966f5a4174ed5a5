#pragma once

#include <span>
#include <vector>

#include "studies/identify/axis_record.hpp"
#include "studies/identify/identify.hpp"

namespace twin::studies::identify {

/// Makes the start of a fit fit the units of its signals: a V-REF scale by which a speed command
/// stays within the converter's range, and the side to which a motor's torque counts. What it
/// changes it notes.
/// @param result  its machine and notes
Expected<void> fit_units(const std::vector<Recording>& recordings, hal::Axis axis,
                         Identification& result);

/// Refuses signals that cannot be true together: torque mode without drive commands and force,
/// force and drive commands of a drive in torque mode that contradict each other.
Expected<void> check_signals(std::span<const AxisRecord> records, hal::Axis axis,
                             const config::MachineFile& machine);

/// Whether an axis moves enough in a record to be validated.
bool moves_enough(const AxisRecord& record);

}  // namespace twin::studies::identify
