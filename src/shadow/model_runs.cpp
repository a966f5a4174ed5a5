#include <cmath>
#include <numbers>
#include <vector>

#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_settings.hpp"
#include "motion/servo/axis_servo.hpp"
#include "shadow/driven_axis.hpp"
#include "shadow/shadow.hpp"

// Healthy runs of a machine file's own table, for a shadow that has learnt nothing.
namespace twin::shadow {
namespace {

constexpr double kTurnTime = 8.0;                            // of each run [s]
constexpr std::array<double, 3> kSpeeds{15.0, 50.0, 100.0};  // largest of each run [mm/s]
constexpr double kRadius = 10.0;                             // of the motion, at most [mm]
constexpr std::array<double, 2> kTurnRatios{1.0, 0.73};      // of x and y, so that they turn apart

/// A motion to and fro whose turns are slow and fast in turn.
motion::Reference reference_at(double time, double radius, double speed) {
  const double slow = 0.31;  // of the modulation [rad/s]
  const double phase = speed / radius * (time + 0.6 / slow * (1.0 - std::cos(slow * time)) * 0.5);
  const double rate = speed / radius * (1.0 + 0.3 * std::sin(slow * time));
  const double growth = speed / radius * 0.3 * slow * std::cos(slow * time);
  return {radius * (1.0 - std::cos(phase)) - radius, radius * std::sin(phase) * rate,
          radius * (std::cos(phase) * rate * rate + std::sin(phase) * growth)};
}

/// One axis in closed loop: drive commands and measured positions.
void run_axis(const config::MachineFile& machine, hal::Axis axis, bool gives, std::size_t run,
              Track& track) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const int steps = hal::mujoco::steps_per_period(machine.period, machine.table.physics_step);
  const double radius = std::min(kRadius, 0.5 * params.travel);
  const double speed = kSpeeds[run] * kTurnRatios[axis];
  const double turn = 0.37 * static_cast<double>(run) + 0.61 * static_cast<double>(axis);
  DrivenAxis plant(params, machine.period, machine.table.physics_step,
                   gives ? ScrewModel::kGives : ScrewModel::kRigid, {});
  hal::mujoco::EncoderParams counts = params.encoder;
  counts.phase = turn - std::floor(turn);
  hal::mujoco::Encoder encoder(counts);
  motion::AxisServo servo(machine.servo[axis], params.mm_per_s_per_volt(), machine.period);
  const motion::Reference first = reference_at(0.0, radius, speed);
  encoder.zero(first.position);
  plant.begin(first.position, 0.0);
  std::vector<double> hum(static_cast<std::size_t>(steps));
  const double omega = 2.0 * std::numbers::pi * params.drive.hum_frequency_Hz;
  for (std::size_t k = 0; k < track.samples.size(); ++k) {
    const double time = static_cast<double>(k) * machine.period;
    for (int i = 0; i < steps; ++i) {
      const double at = time + machine.period * i / steps;
      hum[static_cast<std::size_t>(i)] =
          params.drive.hum_amplitude * std::sin(omega * at + 2.0 * std::numbers::pi * turn);
    }
    plant.advance(plant.position(), hum);
    const double measured =
        first.position +
        motion::position_from_counts(encoder.counts(plant.position()), params.encoder.mm_per_count);
    const double volts = servo.update(reference_at(time, radius, speed), measured);
    plant.command(volts);
    track.samples[k].time = time;
    track.samples[k].axis[axis] = {.measured = measured, .volts = volts};
    track.samples[k].axis[axis].scale = plant.slide();
  }
}

}  // namespace

Expected<Baseline> learn_from_model(const config::MachineFile& machine, bool gives,
                                    const std::array<Recorded, hal::kServoAxes>& recorded) {
  std::vector<Track> tracks(kSpeeds.size());
  for (std::size_t run = 0; run < tracks.size(); ++run) {
    tracks[run].name = "the model";
    tracks[run].recorded = recorded;
    tracks[run].samples.resize(static_cast<std::size_t>(kTurnTime / machine.period));
    run_axis(machine, hal::kX, gives, run, tracks[run]);
    run_axis(machine, hal::kY, gives, run, tracks[run]);
  }
  TWIN_TRY(Baseline baseline, learn(machine, tracks, gives));
  baseline.programs = {"the model"};
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const PerParameter known = known_by_file(machine, axis);
    for (ChannelBaseline& channel : baseline.axis[axis]) {
      for (std::size_t i = 0; i < kParameters; ++i) {
        channel.scatter[i] = std::hypot(channel.scatter[i], known[i]);
      }
    }
  }
  return baseline;
}

Expected<Baseline> baseline_of(const config::MachineFile& machine,
                               const std::filesystem::path& learnt, bool gives,
                               const std::array<Recorded, hal::kServoAxes>& recorded) {
  return learnt.empty() ? learn_from_model(machine, gives, recorded)
                        : read_baseline(learnt, machine);
}

}  // namespace twin::shadow
