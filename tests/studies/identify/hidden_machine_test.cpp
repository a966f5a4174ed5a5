#include "hidden_machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "studies/identify/identification_report.hpp"
#include "studies/identify/identify.hpp"

namespace twin::studies::identify {
namespace hidden_machine_test {

/// A machine that nobody has told the fit of, one trace of it, and what is identified from that.
class HiddenMachine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::TempFolder;
    hidden = new config::MachineFile(hidden_machine(7));
    run_on(*hidden, "identify.nc", *folder / "trace");
    const auto recording =
        read_recording(*folder / "trace/trace.csv", trace_columns(), hidden->limits);
    ASSERT_TRUE(recording) << to_string(recording.error());
    auto result = identify({*recording}, known_machine(), FitOptions());
    ASSERT_TRUE(result) << to_string(result.error());
    found = new Identification(std::move(*result));
  }
  static void TearDownTestSuite() {
    delete found;
    delete hidden;
    delete folder;
  }

  static const FittedParameter& parameter(hal::Axis axis, const std::string& key) {
    const auto& list = found->axis[axis]->parameters;
    return *std::ranges::find_if(list,
                                 [&](const FittedParameter& p) { return p.key.ends_with(key); });
  }

  static inline test::TempFolder* folder = nullptr;
  static inline config::MachineFile* hidden = nullptr;
  static inline Identification* found = nullptr;
};

/// Offset, phase and what is near 0 by nature are compared with what they stand for.
double allowed(const FittedParameter& p, double truth) {
  return 0.05 * std::max(std::abs(truth), p.key.find("phase") != std::string::npos ? 90.0 : 0.0);
}

TEST_F(HiddenMachine, WhatIsWellIdentifiedIsRightWithin5Percent) {
  int known = 0;
  for (const auto& axis : found->axis) {
    for (const FittedParameter& p : axis->parameters) {
      const bool is_found = p.verdict == Verdict::kIdentified || p.verdict == Verdict::kMeasured;
      const bool is_zero = p.key.ends_with("kd") || p.key.ends_with("trim_V");
      if (!is_found || p.relative > 0.02 || is_zero) {
        continue;
      }
      ++known;
      const double truth = value_of(*hidden, p.key);
      EXPECT_NEAR(p.value, truth, allowed(p, truth)) << p.key << " +- " << p.sigma;
    }
  }
  EXPECT_GE(known, 22);
}

TEST_F(HiddenMachine, WhatMovesTheAxisIsAmongIt) {
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const char* key : {"coulomb_friction_N", "velocity_gain_Hz", "integral_time_ms",
                            "vref_scale_rpm_per_V", "vref_offset_mV", "hum_amplitude_mV",
                            "hum_frequency_Hz", "encoder_um_per_count", "kp_per_s", "kf", "ka_s"}) {
      const FittedParameter& p = parameter(axis, key);
      EXPECT_TRUE(p.verdict == Verdict::kIdentified || p.verdict == Verdict::kMeasured) << p.key;
      const double truth = value_of(*hidden, p.key);
      EXPECT_NEAR(p.value, truth, allowed(p, truth)) << p.key << " +- " << p.sigma;
    }
  }
}

TEST_F(HiddenMachine, DeviationsAreHonest) {
  int count = 0;
  int within = 0;
  for (const auto& axis : found->axis) {
    for (const FittedParameter& p : axis->parameters) {
      if (p.verdict == Verdict::kIdentified) {
        ++count;
        within += std::abs(p.value - value_of(*hidden, p.key)) < 3.0 * p.sigma ? 1 : 0;
      }
    }
  }
  EXPECT_GE(within, 0.8 * count) << within << " of " << count << " within 3 sigma";
}

TEST_F(HiddenMachine, MassIsFoundToScaleWithFrictionAndKeepsItsValue) {
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const FittedParameter& mass = parameter(axis, "moving_mass_kg");
    EXPECT_EQ(mass.verdict, Verdict::kUnidentified);
    EXPECT_EQ(mass.value, mass.start);
    EXPECT_NE(mass.why.find("Coulomb friction"), std::string::npos) << mass.why;
  }
}

TEST_F(HiddenMachine, AnotherProgramIsPredictedWithin5Percent) {
  for (const char* program : {"oxalis.nc", "mixed.nc"}) {
    const double truth = run_on(*hidden, program, *folder / "truth");
    const double known = run_on(known_machine(), program, *folder / "known");
    const double predicted = run_on(found->machine, program, *folder / "predicted");
    EXPECT_NEAR(predicted, truth, 0.05 * truth) << program;
    EXPECT_GT(std::abs(known - truth), 0.1 * truth) << program << " tells nothing";
  }
}

TEST_F(HiddenMachine, ItsMachineFileReadsBack) {
  const auto file = folder->put("identified.toml", to_machine_file(*found));
  const auto read = config::read_machine_file(file);
  ASSERT_TRUE(read) << to_string(read.error());
  for (const auto& axis : found->axis) {
    for (const FittedParameter& p : axis->parameters) {
      EXPECT_NEAR(value_of(*read, p.key), p.value, 1e-9 * std::abs(p.value) + 1e-15) << p.key;
    }
  }
}

}  // namespace hidden_machine_test
}  // namespace twin::studies::identify
