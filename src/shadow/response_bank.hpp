#pragma once

#include <vector>

#include "hal/mujoco/change.hpp"
#include "hal/mujoco/table_params.hpp"
#include "shadow/driven_axis.hpp"
#include "shadow/hum_tracker.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// The position that an axis should have by its drive commands, and how that depends on each
/// parameter.
///
/// The identified model and copies of it, each with one parameter changed by a step d, are driven by
/// the same commands. With the positions y of the encoder, y_0 of the model and y_i of a copy,
///   residual = y - y_0,   signature_i = (y_i - y_0) / d_i.
/// A signature holds for small changes. That of backlash, which no model of a sound screw has, is
/// the difference of two models whose screw gives, with and without play.
class ResponseBank {
 public:
  /// @param gives  whether the model's screws give. Allocates.
  ResponseBank(const hal::mujoco::AxisParams& params, double period, double physics_step,
               bool gives);

  /// Begins at a place with the drive command of the first period. Real-time safe.
  void begin(double measured, double volts) noexcept;
  /// One period: a measured position [mm] and the drive command that follows it [V]. Real-time safe.
  /// @param moves  whether the axis is in motion
  SignalRow step(double measured, double volts, bool moves) noexcept;
  /// The same of the slide in that period, by a scale of its own. Real-time safe. @param scale  [mm]
  SignalRow slide_row(double scale) const noexcept;
  /// Velocity of the identified model [mm/s].
  double velocity() const noexcept { return models_.front().velocity(); }
  /// Whether the models have the hum that the machine has.
  bool has_hum() const noexcept { return hum_.is_found(); }
  /// What a force of 1 N that begins in steady motion does to the residual, period by period [um/N].
  std::vector<double> force_response(std::size_t periods) const;
  /// True once the model is not finite any more.
  bool has_failed() const noexcept { return models_.front().has_failed(); }
  /// How many models run side by side.
  std::size_t models() const noexcept { return models_.size(); }

 private:
  struct Copy {
    Cause cause;
    std::size_t model;      // in models_
    std::size_t reference;  // the one it is compared with
    double step;            // in the unit of its cause
  };
  void add(Cause cause, const hal::mujoco::AxisCondition& condition, double step);

  hal::mujoco::AxisParams params_;
  double period_;
  double physics_step_;
  ScrewModel screw_;
  HumTracker hum_;
  template <class PlaceOf>
  void fill(double measured, PlaceOf&& place_of, SignalRow& row) const noexcept;
  std::vector<DrivenAxis> models_;  // the identified one first
  std::vector<Copy> copies_;
};

}  // namespace twin::shadow
