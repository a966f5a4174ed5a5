#include "studies/linuxcnc/machine_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <numbers>
#include <system_error>

#include "core/atomic_file.hpp"
#include "hal/machine.hpp"

namespace twin::studies::linuxcnc {
namespace {

constexpr double kPenVelocityPerVolt = 10.0;  // of a drive Z in profile stg [mm/s/V]
constexpr std::array<char, 3> kLetters{'X', 'Y', 'Z'};

bool is_servo(std::size_t axis) { return axis < hal::kServoAxes; }

/// A limit of one axis, or that of the machine where the axis has none of its own.
double limit_of(double own, double machine) { return own > 0.0 ? std::min(own, machine) : machine; }

double largest_velocity(const config::MachineFile& machine, std::size_t axis) {
  const Limits& limits = machine.limits;
  return limit_of(limits.axis_feedrate[static_cast<Eigen::Index>(axis)],
                  std::min(limits.rapid_feedrate, limits.feedrate));
}

double largest_acceleration(const config::MachineFile& machine, std::size_t axis) {
  return limit_of(machine.limits.axis_acceleration[static_cast<Eigen::Index>(axis)],
                  machine.limits.acceleration);
}

std::string head(const config::MachineFile& machine, const ConfigOptions& options) {
  const bool is_stg = options.profile == ConfigOptions::Profile::kStg;
  std::string text = fmt::format(
      "# LinuxCNC on the table of {0}, written by `twin linuxcnc config`.\n"
      "# Start the table first: twin plant --machine {0}\n\n"
      "[EMC]\nVERSION = 1.1\nMACHINE = twin {0}\nDEBUG = 0\n\n",
      machine.name);
  if (options.headless.empty()) {
    text += "[DISPLAY]\nDISPLAY = axis\n";
  } else {
    text += fmt::format("[DISPLAY]\nDISPLAY = {}{}{}\n", options.headless.string(),
                        options.arguments.empty() ? "" : " ", fmt::join(options.arguments, " "));
  }
  text += fmt::format(
      "CYCLE_TIME = 0.1\nPOSITION_OFFSET = RELATIVE\nPOSITION_FEEDBACK = ACTUAL\n"
      "MAX_FEED_OVERRIDE = 2.0\nPROGRAM_PREFIX = .\n\n"
      "[FILTER]\n\n[RS274NGC]\nPARAMETER_FILE = twin.var\n"
      "RS274NGC_STARTUP_CODE = G17 G21 G90 G94 G64 P{0:g}\n\n"
      "[EMCMOT]\nEMCMOT = motmod\nCOMM_TIMEOUT = 5.0\nSERVO_PERIOD = {1:.0f}\n\n"
      "[TASK]\nTASK = milltask\nCYCLE_TIME = 0.001\n\n[EMCIO]\nEMCIO = io\nCYCLE_TIME = 0.1\n"
      "TOOL_TABLE = tool.tbl\n\n",
      machine.path.chord_error, machine.period * 1e9);
  text += "[HAL]\nHALUI = halui\n";
  for (const char* file : {"core_servo.hal", "stg_motion.hal", "stg_io.hal"}) {
    if (is_stg) {
      // core_servo.hal is in LinuxCNC's own library of HAL files.
      const bool is_library = std::string_view(file) == "core_servo.hal";
      text += fmt::format("HALFILE = {}{}\n",
                          is_library ? "LIB:" : options.hal_files.string() + "/", file);
    }
  }
  text += fmt::format("HALFILE = {}\n\n[HALUI]\n\n", is_stg ? "stg_record.hal" : "twin.hal");
  return text;
}

std::string trajectory(const config::MachineFile& machine) {
  const double acceleration = machine.limits.acceleration;
  return fmt::format(
      "[KINS]\nKINEMATICS = trivkins coordinates=XYZ\nJOINTS = 3\n\n"
      "[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\n"
      "DEFAULT_LINEAR_VELOCITY = {0:g}\nMAX_LINEAR_VELOCITY = {0:g}\n"
      "DEFAULT_LINEAR_ACCELERATION = {1:g}\nMAX_LINEAR_ACCELERATION = {1:g}\n"
      "NO_FORCE_HOMING = 0\n\n",
      std::min(machine.limits.rapid_feedrate, machine.limits.feedrate), acceleration);
}

/// Onto the switch and, where the HAL files connect it, the encoder's index: those that LinuxCNC ships
/// for Servo To Go do not.
std::string homing(const config::MachineFile& machine, std::size_t axis,
                   const ConfigOptions& options) {
  if (!is_servo(axis) || options.is_homed_here) {
    return "HOME = 0\nHOME_OFFSET = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = "
           "0\n";
  }
  const config::HomeSettings& home = machine.home[axis];
  const double towards = home.is_positive ? 1.0 : -1.0;
  return fmt::format(
      "HOME = 0\nHOME_OFFSET = {:g}\nHOME_SEARCH_VEL = {:g}\nHOME_LATCH_VEL = {:g}\n"
      "HOME_FINAL_VEL = {:g}\nHOME_USE_INDEX = {}\nHOME_IGNORE_LIMITS = YES\nHOME_SEQUENCE = 0\n",
      -home.zero, towards * home.seek_feedrate, -towards * home.index_feedrate, home.seek_feedrate,
      options.profile == ConfigOptions::Profile::kStg ? "NO" : "YES");
}

/// Keys of the position loop: those of core_servo.hal, so that either HAL file finds them.
std::string loop(const config::MachineFile& machine, std::size_t axis) {
  if (!is_servo(axis)) {
    return fmt::format(
        "INPUT_SCALE = 1000\nOUTPUT_SCALE = {:g}\nOUTPUT_OFFSET = 0\nMAX_OUTPUT = 100\n"
        "DEADBAND = 0\nP = 20\nI = 0\nD = 0\nFF0 = 0\nFF1 = 1\nFF2 = 0\nBIAS = 0\n",
        1.0 / kPenVelocityPerVolt);
  }
  const auto& table = machine.table.axis[axis];
  const motion::Gains& gains = machine.servo[axis];
  const double per_volt = table.mm_per_s_per_volt();
  return fmt::format(
      "# Counts per mm; V per mm/s of the drive command.\n"
      "INPUT_SCALE = {:.10g}\nOUTPUT_SCALE = {:.10g}\nOUTPUT_OFFSET = 0\n"
      "# Largest command of the drive, 10 V [mm/s].\nMAX_OUTPUT = {:g}\nDEADBAND = 0\n"
      "P = {:.10g}\nI = 0\nD = {:.10g}\nFF0 = 0\nFF1 = {:.10g}\nFF2 = {:.10g}\n"
      "# Against the drive's offset [mm/s].\nBIAS = {:.10g}\n",
      1.0 / table.encoder.mm_per_count, 1.0 / per_volt, 10.0 * std::abs(per_volt), gains.kp,
      gains.kd + gains.kv, gains.kf - gains.kv, gains.ka, gains.trim_V * per_volt);
}

/// Following errors that are allowed at rest and at the largest velocity [mm].
std::array<double, 2> following_errors(const config::MachineFile& machine, std::size_t axis) {
  const double velocity = largest_velocity(machine, axis);
  if (!is_servo(axis)) {
    // The pen slide lags behind its reference like a critically damped spring, by 2 v / omega.
    const double lag = velocity / (std::numbers::pi * machine.table.pen_bandwidth_Hz);
    return {2.0 * lag, 2.0 * lag};
  }
  const motion::SafetySettings& safety = machine.safety;
  return {safety.tracking_error,
          safety.tracking_error + safety.tracking_error_per_feedrate * velocity};
}

std::string joint(const config::MachineFile& machine, std::size_t axis,
                  const ConfigOptions& options) {
  const auto k = static_cast<Eigen::Index>(axis);
  const std::string limits = fmt::format(
      "MIN_LIMIT = {:g}\nMAX_LIMIT = {:g}\nMAX_VELOCITY = {:g}\nMAX_ACCELERATION = {:g}\n",
      machine.limits.travel_min[k], machine.limits.travel_max[k], largest_velocity(machine, axis),
      largest_acceleration(machine, axis));
  const auto [at_rest, at_speed] = following_errors(machine, axis);
  return fmt::format(
      "[AXIS_{}]\n{}\n[JOINT_{}]\nTYPE = LINEAR\n{}BACKLASH = 0\nMIN_FERROR = {:g}\nFERROR = {:g}\n"
      "{}{}\n",
      kLetters[axis], limits, axis, limits, at_rest, at_speed, loop(machine, axis),
      homing(machine, axis, options));
}

std::string servo_nets(char letter, std::size_t joint_number) {
  return fmt::format(
      "setp pid.{0}.maxoutput [JOINT_{1}]MAX_OUTPUT\n"
      "setp pid.{0}.deadband [JOINT_{1}]DEADBAND\n"
      "setp pid.{0}.bias [JOINT_{1}]BIAS\n"
      "setp pid.{0}.Pgain [JOINT_{1}]P\n"
      "setp pid.{0}.Igain [JOINT_{1}]I\n"
      "setp pid.{0}.Dgain [JOINT_{1}]D\n"
      "setp pid.{0}.FF0 [JOINT_{1}]FF0\n"
      "setp pid.{0}.FF1 [JOINT_{1}]FF1\n"
      "setp pid.{0}.FF2 [JOINT_{1}]FF2\n"
      "setp twin.{0}.position-scale [JOINT_{1}]INPUT_SCALE\n"
      "net {0}-enable joint.{1}.amp-enable-out => pid.{0}.enable twin.{0}.enable\n"
      "net {0}-command joint.{1}.motor-pos-cmd => pid.{0}.command\n"
      "net {0}-feedback twin.{0}.position-fb => pid.{0}.feedback joint.{1}.motor-pos-fb\n"
      "net {0}-output pid.{0}.output => twin.{0}.velocity-cmd\n"
      "net {0}-index twin.{0}.index-enable pid.{0}.index-enable joint.{1}.index-enable\n"
      "net {0}-fault twin.{0}.fault => joint.{1}.amp-fault-in\n"
      "net {0}-limit-pos twin.{0}.limit-pos => joint.{1}.pos-lim-sw-in\n"
      "net {0}-limit-neg twin.{0}.limit-neg => joint.{1}.neg-lim-sw-in\n"
      "net {0}-home twin.{0}.home => joint.{1}.home-sw-in\n"
      "# For the record: what was asked of the joint, and where its zero is.\n"
      "net {0}-set-point joint.{1}.pos-cmd => twin.{0}.commanded\n"
      "net {0}-offset joint.{1}.motor-offset => twin.{0}.motor-offset\n\n",
      letter, joint_number);
}

}  // namespace

std::string ini_text(const config::MachineFile& machine, const ConfigOptions& options) {
  std::string text = head(machine, options) + trajectory(machine);
  for (std::size_t axis = 0; axis < kLetters.size(); ++axis) {
    text += joint(machine, axis, options);
  }
  return text;
}

std::string hal_text(const config::MachineFile& machine, const std::string& segment) {
  std::string text = fmt::format(
      "# HAL of the table of {}: `twin plant` behind the component twin, LinuxCNC's pid in front.\n"
      "loadrt [KINS]KINEMATICS\n"
      "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS\n"
      "loadrt pid names=pid.x,pid.y\nloadrt twin{}\nloadrt and2\n\n"
      "addf twin.read servo-thread\naddf motion-command-handler servo-thread\n"
      "addf motion-controller servo-thread\naddf pid.x.do-pid-calcs servo-thread\n"
      "addf pid.y.do-pid-calcs servo-thread\naddf and2.0 servo-thread\naddf twin.write "
      "servo-thread\n\n",
      machine.name, segment.empty() ? "" : " segment=" + segment);
  text += servo_nets('x', 0) + servo_nets('y', 1);
  text +=
      "net z-command joint.2.motor-pos-cmd => twin.z.position-cmd\n"
      "net z-feedback twin.z.position-fb => joint.2.motor-pos-fb\n"
      "net z-offset joint.2.motor-offset => twin.z.motor-offset\n\n"
      "net line motion.program-line => twin.line\n"
      "# A program is recorded, MDI is not.\n"
      "net is-running halui.program.is-running => and2.0.in0\n"
      "net is-auto halui.mode.is-auto => and2.0.in1\n"
      "net recording and2.0.out => twin.record\n\n"
      "net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n"
      "net fault-reset iocontrol.0.user-request-enable => twin.x.fault-reset twin.y.fault-reset\n"
      "net tool-prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared\n"
      "net tool-change iocontrol.0.tool-change => iocontrol.0.tool-changed\n";
  return text;
}

std::string stg_record_text() {
  std::string text =
      "# What hal_stg records besides what the driver of the card knows; a machine needs none of "
      "it.\n";
  for (int i = 0; i < 3; ++i) {
    text += fmt::format(
        "net set-point-{0} joint.{0}.pos-cmd => stg.{0}.commanded\n"
        "net offset-{0} joint.{0}.motor-offset => stg.{0}.motor-offset\n",
        i);
  }
  return text +
         "net line motion.program-line => stg.line\n"
         "loadrt and2\naddf and2.0 servo-thread\n"
         "net is-running halui.program.is-running => and2.0.in0\n"
         "net is-auto halui.mode.is-auto => and2.0.in1\n"
         "net recording and2.0.out => stg.record\n";
}

Expected<std::vector<std::filesystem::path>> write_config(const config::MachineFile& machine,
                                                          const std::filesystem::path& folder,
                                                          const std::filesystem::path& headless,
                                                          const std::filesystem::path& hal_files) {
  using Profile = ConfigOptions::Profile;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return file_error(folder, "make this folder", error.value());
  }
  const ConfigOptions axis{};
  ConfigOptions without_display;
  without_display.headless = headless;
  ConfigOptions stg = without_display;
  stg.profile = Profile::kStg;
  stg.hal_files = hal_files;
  const std::array<std::pair<const char*, std::string>, 6> files{{
      {"twin.ini", ini_text(machine, axis)},
      {"headless.ini", ini_text(machine, without_display)},
      {"twin.hal", hal_text(machine)},
      {"stg.ini", ini_text(machine, stg)},
      {"stg_record.hal", stg_record_text()},
      {"tool.tbl", "T1 P1 D1.0 Z0.0 ;pen\n"},
  }};
  std::vector<std::filesystem::path> written;
  for (const auto& [name, text] : files) {
    written.push_back(folder / name);
    TWIN_CHECK(write_whole_file(written.back(), text));
  }
  return written;
}

}  // namespace twin::studies::linuxcnc
