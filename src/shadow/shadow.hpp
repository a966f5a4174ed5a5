#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "shadow/axis_shadow.hpp"
#include "shadow/baseline.hpp"

namespace twin::shadow {

/// One period of a run, as the shadow sees it.
struct ShadowSample {
  double time = 0.0;      ///< since the first set point [s]
  std::int64_t line = 0;  ///< of the NC program; 0: unknown
  std::array<AxisSample, hal::kServoAxes> axis;
};

/// A recorded run.
struct Track {
  std::string name;  ///< for messages and for what was learnt
  std::vector<ShadowSample> samples;
  std::array<Recorded, hal::kServoAxes> recorded;
  std::array<bool, hal::kServoAxes> is_recorded{true, true};
};

/// Watches all axes of a machine.
class Shadow {
 public:
  /// @param hours  mean time between false alarms [h]. Allocates.
  Shadow(const config::MachineFile& machine, const Baseline& baseline, bool gives, double hours,
         const std::array<Recorded, hal::kServoAxes>& recorded);

  /// One period. @returns whether something new was found
  bool step(const ShadowSample& sample);

  /// The shadow of an axis; null where there is nothing to watch.
  const AxisShadow* axis(hal::Axis axis) const noexcept {
    return axes_[axis] ? &*axes_[axis] : nullptr;
  }
  bool has_failed() const noexcept;

 private:
  std::array<std::optional<AxisShadow>, hal::kServoAxes> axes_;
};

/// Finds what healthy runs of a machine are like.
/// @param stop  ends it once it is set; may be null
/// @returns an error that names the axis that moves too little, where none moves enough
Expected<Baseline> learn(const config::MachineFile& machine, const std::vector<Track>& tracks,
                         bool gives, const std::atomic<bool>* stop = nullptr);

/// What healthy runs of the machine file's own table are like: for a shadow that has learnt nothing.
/// Motion, hum and the phases of the encoder are simulated; what [uncertainty] says of the
/// parameters is added to their scatter.
Expected<Baseline> learn_from_model(const config::MachineFile& machine, bool gives,
                                    const std::array<Recorded, hal::kServoAxes>& recorded);

/// What a shadow goes by: a file of what was learnt of healthy runs, or, where that is empty, what the
/// model has learnt.
Expected<Baseline> baseline_of(const config::MachineFile& machine,
                               const std::filesystem::path& learnt, bool gives,
                               const std::array<Recorded, hal::kServoAxes>& recorded);

/// A model that nobody has identified has no shadow.
Expected<void> check_identified(const config::MachineFile& machine);

/// A baseline must be of the same signals as the track that it is held against.
Expected<void> check_signals(const Baseline& baseline, const Track& track,
                             const config::MachineFile& machine);

/// What was learnt, a line for each channel of each axis.
std::string to_text(const Baseline& baseline, const config::MachineFile& machine);

/// One line on what was found, as in "axis x: friction +31 % (+- 3), since 2.35 s, line 120; seen at
/// 3.1 s".
std::string to_line(const Finding& finding, hal::Axis axis);

}  // namespace twin::shadow
