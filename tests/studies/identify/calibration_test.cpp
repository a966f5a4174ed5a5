#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "hidden_machine.hpp"
#include "simulated_recording.hpp"
#include "studies/identify/identify.hpp"

/// Whether deviations hold: of what is called identified on machines that nobody has told the fit
/// of, 95 % lies within two deviations. Every other machine has features that the fitted model
/// lacks.
namespace twin::studies::identify {
namespace calibration_test {

/// A feature that no search fits.
void add_feature(hal::mujoco::AxisParams& axis, motion::Gains& servo, unsigned kind) {
  switch (kind % 7) {
    case 0:
      axis.drive.velocity_loop_period = 0.5e-3;
      axis.drive.speed_delay = 1e-3;
      break;
    case 1:
      axis.friction.viscous_asymmetry = 0.4 * axis.friction.viscous;
      axis.friction.coulomb_asymmetry = 0.2 * axis.friction.coulomb;
      break;
    case 2:
      axis.load.ripple_amplitude = 0.3 * axis.friction.coulomb;
      break;
    case 3:
      axis.friction.law = hal::mujoco::FrictionLaw::kMaxwell;
      break;
    case 4:
      axis.drive.integral_time = 0.0;
      break;
    case 5:
      axis.encoder.delay = 2e-3;
      break;
    default:
      axis.drive.input_lag = 1.5e-3;
      servo.command_delay = 2.5e-3;
  }
}

struct Count {
  int identified = 0;
  int within = 0;
};

/// Identifies one machine and counts what lies within two deviations.
void study(unsigned seed, Count& count) {
  config::MachineFile hidden = hidden_machine(seed);
  hal::mujoco::AxisParams& axis = hidden.table.axis[hal::kX];
  axis.encoder.mm_per_count = seed % 3 == 0 ? 5e-3 : seed % 3 == 1 ? 1e-3 : 1e-4;
  hidden.table.physics_step = 0.2e-3;
  if (seed % 2 == 1) {
    add_feature(axis, hidden.servo[hal::kX], seed / 2);
  }
  const auto what = static_cast<Recorded>((seed / 4) % 3);
  config::MachineFile start = known_machine();
  start.table.physics_step = 0.2e-3;
  FitOptions options;
  options.evaluations = 200;
  const auto result = identify({record_x(hidden, what, 4.0)}, start, options);
  ASSERT_TRUE(result) << to_string(result.error());
  for (const FittedParameter& p : result->axis[hal::kX]->parameters) {
    if (p.verdict != Verdict::kIdentified) {
      continue;
    }
    const double truth = value_of(hidden, p.key);
    double error = p.value - truth;
    if (p.key.ends_with("phase_deg")) {
      error = std::remainder(error, 360.0);
    }
    const bool is_within = std::abs(error) <= 2.0 * p.sigma;
    ++count.identified;
    count.within += is_within ? 1 : 0;
    if (!is_within) {
      std::printf("machine %u (%d, feature %d), residual %.2f of rounding: %s %g +- %g, true %g\n",
                  seed, static_cast<int>(what), seed % 2 == 1 ? static_cast<int>(seed / 2 % 7) : -1,
                  result->axis[hal::kX]->residual_rms / result->axis[hal::kX]->rounding_rms,
                  p.key.c_str(), p.value, p.sigma, truth);
    }
  }
}

TEST(Calibration, WhatIsCalledIdentifiedLiesWithinTwoDeviations) {
  // All 200 take minutes: TWIN_CALIBRATION=200. Without, a few of them. TWIN_CALIBRATION_FIRST=3000
  // takes other machines.
  const char* const asked = std::getenv("TWIN_CALIBRATION");
  const char* const first_asked = std::getenv("TWIN_CALIBRATION_FIRST");
  const unsigned first = first_asked != nullptr ? static_cast<unsigned>(std::atoi(first_asked)) : 4;
  const unsigned machines = asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : 3;
  const unsigned stride = asked != nullptr ? 1 : 5;
  Count count;
  for (unsigned i = 0; i < machines; ++i) {
    study(first + stride * i, count);
  }
  std::printf("%d of %d identified parameters of %u machines within 2 deviations\n", count.within,
              count.identified, machines);
  EXPECT_GT(count.identified, static_cast<int>(machines));
  const double share = static_cast<double>(count.within) / std::max(count.identified, 1);
  EXPECT_GE(share, machines >= 100 ? 0.95 : 0.9);
}

}  // namespace calibration_test
}  // namespace twin::studies::identify
