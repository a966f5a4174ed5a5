#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "config/machine_file.hpp"
#include "hal/machine.hpp"
#include "shadow/channel_filter.hpp"
#include "shadow/force_balance.hpp"
#include "shadow/learn.hpp"
#include "shadow/response_bank.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// What one axis tells in a period.
struct AxisSample {
  double measured = 0.0;  ///< position by the encoder [mm]
  double volts = 0.0;     ///< drive command that follows it [V]
  double force = 0.0;     ///< of the motor at the slide, where it is known [N]
  double scale = 0.0;     ///< position of the slide, where a scale measures it [mm]
};

/// What of an axis is recorded.
struct Recorded {
  bool has_volts = true;
  bool has_force = false;
  bool has_scale = false;
};

/// What an axis shows in a period.
struct Observation {
  std::array<SignalRow, kChannels> row;  ///< of each channel of the observer
  /// Of each channel, whether the axis moves, and has done so for as long as the channel remembers.
  std::array<bool, kChannels> moves{};
  double direction = 0.0;  ///< of the motion kMemory periods ago; 0 where it was slow
  double heading = 0.0;    ///< direction of the model now; 0 where it is slow
  bool is_slow = false;    ///< the model is so slow that friction may hold the axis
  double counts = 0.0;     ///< way of the measured position [counts]
};

/// Watches one axis: the channels that its recorded signals allow, and its motion.
///
/// A drive in speed mode has the channels of the position and of the counts, and that of the scale where there is one. A
/// drive in torque mode has the channel of the force, and so has one whose force is recorded.
class AxisObserver {
 public:
  static constexpr std::size_t kMemory = 64;  ///< periods by which motion is judged

  /// @param gives  whether the screws of the model give. Allocates.
  AxisObserver(const config::MachineFile& machine, hal::Axis axis, bool gives, Recorded recorded);

  /// One period. Real-time safe.
  Observation step(const AxisSample& sample) noexcept;

  const std::vector<ChannelKind>& channels() const noexcept { return channels_; }
  /// What the filter of a channel must know. Allocates.
  ChannelFacts facts(std::size_t channel) const;
  bool has_failed() const noexcept { return bank_ && bank_->has_failed(); }
  /// How many models run side by side.
  std::size_t models() const noexcept { return bank_ ? bank_->models() : 0; }

 private:
  void judge_motion(double measured, Observation& seen) noexcept;

  std::vector<ChannelKind> channels_;
  std::optional<ResponseBank> bank_;
  std::optional<ForceBalance> balance_;
  double force_per_volt_ = 0.0;  // torque mode [N/V]
  double hum_angle_ = 0.0;       // in a period [rad]
  double mm_per_count_;          // > 0 [mm]
  static constexpr std::size_t kAround = 8;
  static constexpr std::size_t kPlaces = kMemory + kAround;
  std::array<double, kPlaces> places_{};  // measured, a ring [mm]
  std::size_t next_ = 0;
  std::size_t seen_ = 0;
  std::size_t since_motion_ = kMemory;
  std::size_t stood_for_ = 0;
  std::size_t in_motion_ = 0;
  std::size_t has_hum_for_ = 0;  // periods since the models have the hum
};

/// How loosely the parameters of an axis are known before anything is learnt: standard deviations,
/// in the units of the causes.
PerParameter loosely_known(const hal::mujoco::AxisParams& params);
/// The largest changes that are plausible.
PerParameter plausible(const hal::mujoco::AxisParams& params);
/// The same of what [uncertainty] of the machine file says.
PerParameter known_by_file(const config::MachineFile& machine, hal::Axis axis);

/// Whether the screws of a model file give: whether it has a tendon of that name.
Expected<bool> screws_give(const config::MachineFile& machine);

}  // namespace twin::shadow
