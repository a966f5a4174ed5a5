#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "core/program_settings.hpp"
#include "core/setting.hpp"
#include "core/wall_clock.hpp"
#include "hal/machine.hpp"
#include "hal/mujoco/table_params.hpp"
#include "hal/rig/rig_settings.hpp"
#include "motion/motion_settings.hpp"

/// Settings: the machine file (TOML) and what the command line changes of it.
namespace twin::config {

/// Where an axis has its home, section [home.x] of the machine file.
struct HomeSettings {
  bool is_positive = false;     ///< home switch is P-OT; else N-OT
  double seek_feedrate = 10.0;  ///< towards the switch, and to zero afterwards [mm/s]
  double index_feedrate = 1.0;  ///< off the switch and to the index [mm/s]
  double zero = 0.0;            ///< from the index to the axis' zero, signed [mm]
};

/// How set points are corrected by the identified model, section [compensation].
struct CompensationSettings {
  double limit = 0.05;            ///< largest offset of an axis [mm]
  double path_tolerance = 0.002;  ///< corner error that a corrected run is planned for [mm]
  double reserve = 0.2;  ///< share of acceleration and jerk that is kept for the offsets [-]
  double highest_frequency = 80.0;  ///< above which nothing is corrected [Hz]
};

/// How well the numbers of the table are known where no identification says it, section
/// [uncertainty]: standard deviations as shares of the values.
struct UncertaintySettings {
  double inertia = 0.05;    ///< of moving masses [-]
  double friction = 0.1;    ///< of Coulomb and viscous friction and bristle stiffness [-]
  double loop_gain = 0.05;  ///< of gain and integral time of the velocity loop [-]
  double delay = 0.1;       ///< of current lag and output delay [-]
  double offset = 0.1;      ///< of the offset of V-REF [-]
};

/// What watches a run, section [shadow].
struct ShadowSettings {
  bool stops = false;     ///< a finding brakes on the path and ends the run; else it is only told
  double hours = 1000.0;  ///< mean time between false alarms [h]
  bool reads_counts = false;  ///< counts bound the position; else rounding is noise
  bool has_scale = false;  ///< the position of the table is measured apart from the motor's encoder
};

/// Everything a machine file says, in base units.
struct MachineFile {
  std::string name = "xy_table";  ///< the file's name without extension
  std::filesystem::path file;     ///< where it was read from; empty: the built-in values
  ProgramSettings program;
  Limits limits;
  PlanningModel planning;
  PathSettings path;
  double period = 0.001;  ///< interpolation period T [s]
  motion::InterpolatorSettings interpolation;
  std::array<motion::Gains, hal::kServoAxes> servo;
  CompensationSettings compensation;
  UncertaintySettings uncertainty;
  ShadowSettings shadow;
  motion::SafetySettings safety;
  RealtimeSettings realtime;
  hal::mujoco::TableParams table;  ///< table.model is absolute once read
  hal::rig::RigSettings rig;       ///< cards and wires of the real machine
  std::array<HomeSettings, hal::kServoAxes> home;

  /// What is not as the settings ask, or was asked for by a former name: one sentence each, to be
  /// shown to the user.
  std::vector<std::string> notes;

  /// Appends a note, unless it is there already; nothing for an empty one.
  void add_note(std::string note);
};

/// Reads a machine file and then applies `section.key=value` texts to it, in order.
///
/// Keys that the file does not have keep the values of MachineFile. Errors of the file are kFile
/// and have file, line and column; those of an override are kUsage.
Expected<MachineFile> read_machine_file(const std::filesystem::path& file,
                                        std::span<const std::string> overrides = {});

/// The same from a text; `file` is what messages call it and what paths in it are relative to.
Expected<MachineFile> parse_machine_file(std::string_view text, const std::filesystem::path& file,
                                         std::span<const std::string> overrides = {});

/// Applies one `section.key=value`, as --set takes it.
///
/// The value is what would stand in the file; a text needs no quotes. Errors are kUsage and name
/// the nearest key.
Expected<void> apply_override(MachineFile& machine, std::string_view text);

/// Applies several in order, then checks what they say together.
Expected<void> apply_overrides(MachineFile& machine, std::span<const std::string> texts);

/// All settings as the text of a machine file: sections, keys with units, what each means and its
/// range.
///
/// Reading it back gives the same values.
/// @param comment  replaces the comment of a key ("table.x.moving_mass_kg") where it returns one
std::string to_toml(const MachineFile& machine,
                    const std::function<std::string(const std::string&)>& comment = {});

/// All settings of a machine as values, in the order and the units of to_toml().
std::vector<Setting> settings_of(const MachineFile& machine);

}  // namespace twin::config
