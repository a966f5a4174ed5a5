#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::linuxcnc {

/// What LinuxCNC is configured for besides the machine file.
struct ConfigOptions {
  /// Which components the HAL file loads.
  enum class Profile {
    kTwin,  ///< `twin`: pins by the names of the axes
    kStg,   ///< `hal_stg`: HAL files that LinuxCNC ships, as they are
  };
  Profile profile = Profile::kTwin;
  bool is_homed_here = false;            ///< zero is where the table stands; else the home switches
  std::filesystem::path headless{};      ///< script that takes the place of a display; empty: AXIS
  std::vector<std::string> arguments{};  ///< of the script
  std::filesystem::path hal_files{};     ///< folder of the HAL files that LinuxCNC ships, of kStg
};

/// Text of an INI file of LinuxCNC for the table of a machine file: gains, scales, limits, homing.
///
/// The position loop is LinuxCNC's own pid with P = Kp, D = Kd + Kv, FF1 = Kf - Kv, FF2 = Ka, an
/// output in mm/s and a feedback in mm: D works on the error, so that it feeds the velocity back and
/// needs that much less of it fed forward. Rapids have rapid_feedrate, which LinuxCNC also makes the largest
/// feedrate. Following error: MIN_FERROR and FERROR are the limits of [safety] at rest and at that
/// feedrate. An axis homes on the switch of [home], then on the encoder's index.
std::string ini_text(const config::MachineFile& machine, const ConfigOptions& options);

/// Text of the HAL file that goes with it, of Profile::kTwin.
/// @param segment  shared memory of the plant; empty: the user's own
std::string hal_text(const config::MachineFile& machine, const std::string& segment = {});

/// Text of the HAL file that tells `hal_stg` what is to be recorded.
std::string stg_record_text();

/// Writes a configuration: twin.ini for AXIS and headless.ini, twin.hal, tool.tbl, stg.ini.
/// @param headless   script of a run without a display  @param hal_files  see ConfigOptions
Expected<std::vector<std::filesystem::path>> write_config(const config::MachineFile& machine,
                                                          const std::filesystem::path& folder,
                                                          const std::filesystem::path& headless,
                                                          const std::filesystem::path& hal_files);

}  // namespace twin::studies::linuxcnc
