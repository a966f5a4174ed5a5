#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/dac.hpp"
#include "hal/machine.hpp"
#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

class TablePlant;

/// The servo XY table as a MuJoCo model, behind the wires of a real one.
///
/// It joins converters, plant and encoders. One period of simulated time passes inside each read():
/// the plant makes n = period / physics_step steps with the outputs of the last write(), which
/// reach the drive output_delay later.
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
  std::optional<Error> configure(double period) override;
  std::optional<Error> activate() override;
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
  void set_external_force(Axis axis, double force) noexcept;
  /// Velocity of a slide [mm/s]. Real-time safe.
  double velocity(Axis axis) const noexcept;

 private:
  enum class Fault { kNone, kNotConfigured, kNotActive, kNotANumber, kPlant };

  Status stop_with(Fault fault) noexcept;
  void fill(Inputs& inputs) const noexcept;

  TableParams params_;
  MachineInfo info_;
  State state_ = State::kUnconfigured;
  Fault fault_ = Fault::kNone;
  std::vector<Dac> dacs_;
  std::unique_ptr<TablePlant> plant_;
  std::vector<Encoder> encoders_;
  std::array<double, kServoAxes> origin_{};          // of truth(), set by activate() [mm]
  std::array<double, kServoAxes> external_force_{};  // [N]
};

}  // namespace twin::hal::mujoco
