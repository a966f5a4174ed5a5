#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "shadow/shadow.hpp"

namespace twin::shadow {

/// What a shadow saw of one axis.
struct AxisReport {
  bool is_watched = false;
  double motion = 0.0;           ///< time in motion [s]
  std::size_t models = 0;        ///< that ran beside the axis
  std::optional<Finding> found;  ///< when it was announced
  std::optional<Finding> last;   ///< the same with all that came after it
  std::vector<AxisShadow::Estimate> estimates;
  std::vector<StripPoint> strip;
};

/// What a shadow saw of a run.
struct ShadowReport {
  std::array<AxisReport, hal::kServoAxes> axis;
  std::vector<std::string> learnt_from;
  std::string switched_off;         ///< why; empty: it watched to the end
  std::int64_t periods = 0;         ///< that were watched
  double cost = 0.0;                ///< of the shadow's thread for each of them [s]
  double hours = 0.0;               ///< mean time between false alarms that was asked for [h]
  double period = 0.0;              ///< [s]
  bool stops = false;               ///< the reaction to a finding
  std::vector<std::string> trends;  ///< what the history shows
};

ShadowReport make_report(const Shadow& shadow, const Baseline& baseline,
                         const config::MachineFile& machine);

/// shadow.json.
std::string to_json(const ShadowReport& report);
/// What was found, a line for each axis.
std::string to_text(const ShadowReport& report);

/// Appends a run to the history: a line for each parameter of each axis, with a header where the
/// file is new. Then says what the history shows: parameters whose mean change from run to run is
/// above five of its deviations.
/// @param when  as "2026-11-28T07:10:00Z"
/// @returns the trends, a line each; or an error that names file and line
Expected<std::vector<std::string>> add_to_history(const std::filesystem::path& file,
                                                  const std::string& when,
                                                  const std::string& program,
                                                  const ShadowReport& report);

}  // namespace twin::shadow
