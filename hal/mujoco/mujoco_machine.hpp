#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/machine.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal {

class TablePhysics;

/// The servo XY table as a MuJoCo model, behind the wires of a real one.
///
/// MuJoCo integrates the masses (semi-implicit Euler, no contacts, no constraints); converter,
/// drive, friction and encoder act on them as generalised forces, written anew before every physics
/// step. One period of simulated time passes inside each read(): n = period / physics_step steps
/// with the outputs of the last write(), which reach the drive output_delay later.
///
/// Without an active state the drives are off, but time still passes in read(): friction alone
/// holds the table. Nothing depends on the wall clock or on other machines in the process: the same
/// calls give the same bytes.
class MujocoMachine final : public Machine {
 public:
  explicit MujocoMachine(TableParams params);
  ~MujocoMachine() override;

  const MachineInfo& info() const noexcept override { return info_; }
  State state() const noexcept { return state_; }
  Expected<void> configure(double period) override;
  Expected<void> activate() override;
  Status read(Inputs& inputs) noexcept override;
  Status write(const Outputs& outputs) noexcept override;
  Truth truth() const noexcept override;
  void deactivate() noexcept override;
  void cleanup() noexcept override;
  std::string last_error() const override;

  /// Position of the pen slide [mm]. Real-time safe.
  double pen_position() const noexcept;
  /// A force on a slide from outside, until changed, along its positive direction [N]. Real-time
  /// safe.
  void set_external_force(Axis axis, double force) noexcept { external_force_[axis] = force; }
  /// Velocity of a slide [mm/s]. Real-time safe.
  double velocity(Axis axis) const noexcept;

 private:
  enum class Fault { kNone, kNotConfigured, kNotActive, kNotANumber, kUnstable, kMujoco };

  Status stop_with(Fault fault) noexcept;
  bool advance() noexcept;
  void step();
  void fill(Inputs& inputs) const noexcept;

  TableParams params_;
  MachineInfo info_;
  State state_ = State::kUnconfigured;
  Fault fault_ = Fault::kNone;
  std::array<char, 200> fault_text_{};  // MuJoCo's words, kept without allocating
  std::unique_ptr<TablePhysics> physics_;
  std::vector<TableAxis> axes_;
  std::array<double, kServoAxes> origin_{};          // of truth(), set by activate() [mm]
  std::array<double, kServoAxes> external_force_{};  // [N]
  double pen_reference_ = 0.0;                       // [mm]
  double step_ = 0.0;                                // physics step [s]
  int steps_ = 0;                                    // physics steps in a period
  std::int64_t steps_done_ = 0;                      // since configure()
};

}  // namespace twin::hal
