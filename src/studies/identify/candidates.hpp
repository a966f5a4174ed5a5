#pragma once

#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {

/// A parameter that a trace of one axis may show.
struct Candidate {
  Parameter parameter;
  std::string name;   ///< for people: "Coulomb friction"
  int hold_rank = 0;  ///< of several that the data cannot tell apart, the lowest is held
  /// Without a record of the drive command the loop's gains are fitted along; the screw where the
  /// table's position was recorded.
  enum class When { kAlways, kWithVolts, kWithoutVolts, kWithTable } when = When::kAlways;
  double natural = 0.0;           ///< a value so small is as good as 0, in the key's unit
  bool is_analysed_only = false;  ///< not searched for, only looked at: it scales with others
};

/// "table.x." or "table.y."
std::string table_section(hal::Axis axis);

/// What can be fitted of an axis, in the order in which it is reported.
/// @param machine  where the search starts; widens ranges that would leave it out
std::vector<Candidate> axis_candidates(const config::MachineFile& machine, hal::Axis axis);

/// Full keys of parameters that a trace can be fitted for: "table.x.moving_mass" is
/// "table.x.moving_mass_kg".
///
/// @param names    as a user gives them, with or without the unit
/// @param machine  whose parameters they are
/// @returns the keys in the order of the names, or a kUsage error that says what was meant
Expected<std::vector<std::string>> full_keys(const std::vector<std::string>& names,
                                             const config::MachineFile& machine);

}  // namespace twin::studies::identify
