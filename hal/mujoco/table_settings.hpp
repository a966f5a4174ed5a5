#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// One number of the machine file: its key, where it goes, and what it may be.
struct Setting {
  std::string_view key;       ///< in the file, with its unit
  double* value = nullptr;    ///< in base units
  double to_base = 1.0;       ///< base value = file value x to_base
  double min = 0.0;           ///< in the file's unit
  double max = 0.0;           ///< in the file's unit
  std::string_view doc = {};  ///< what it means, in a few words
};

/// Numbers of [table], except `model`, which is text.
std::vector<Setting> table_settings(TableParams& params);

/// Numbers of [table.x] and [table.y], except `dac_bits`, which is whole.
std::vector<Setting> axis_settings(AxisParams& params);

inline constexpr int kMinDacBits = 2;
inline constexpr int kMaxDacBits = 48;

/// Checks every number against its range. @returns kMachine error naming key, value and range
Expected<void> validate(const TableParams& params);

/// Physics steps in a period: the fewest that are no longer than the physics step asked for.
int steps_per_period(double period, double physics_step) noexcept;

}  // namespace twin::hal::mujoco
