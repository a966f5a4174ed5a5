#include <gtest/gtest.h>

#include <filesystem>

#include "studies/identify/identify.hpp"
#include "studies/shadow/recorded_track.hpp"

/// The shadow on recordings of real machines, where they are beside the project: identified and
/// learnt from the first half, held against the second.
namespace twin::studies::shadow {
namespace measured_shadow_test {

using twin::shadow::Shadow;
using twin::shadow::Track;

const std::filesystem::path kData = TWIN_SOURCE_DIR "/../shared/data";
constexpr const char* kEmps = "t=t_s,x_cmd=qg_m:m,x_meas=qm_m:m,x_V=vir_V,x_force=force_N";
constexpr const char* kSinumerik =
    "t=t_s,x_cmd=x_des_pos_mm,x_meas=x_enc_pos_mm,x_V=x_cmd_speed:mm/s,x_torque=x_torque_N_m:N_m,"
    "y_cmd=y_des_pos_mm,y_meas=y_enc_pos_mm,y_V=y_cmd_speed:mm/s,y_torque=y_torque_N_m:N_m";

/// How much more force the changed machine needs, and from when on [s].
constexpr double kMore = 1.2;
constexpr double kEmpsChange = 18.4;  // 6 s into the second half

template <class T>
T checked(Expected<T> value) {
  if (!value) {
    throw std::runtime_error(to_string(value.error()));
  }
  return *std::move(value);
}

config::MachineFile start_machine(double period) {
  auto machine = checked(config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml"));
  machine.table.physics_step = 0.25e-3;
  machine.period = period;
  return machine;
}

/// A recorded machine, identified from the first half of its recording.
struct Recorded {
  config::MachineFile machine;
  Track first;
  Track second;
  twin::shadow::Baseline baseline;
};

/// The first rows of a recording.
void keep_first(std::size_t rows, identify::Recording& recording) {
  for (identify::AxisSignals& axis : recording.axis) {
    for (auto* signal : {&axis.command, &axis.measured, &axis.volts, &axis.force}) {
      signal->resize(std::min(signal->size(), rows));
    }
  }
  recording.rows = rows;
}

Recorded learn_half(const char* file, const char* columns, config::MachineFile start) {
  const auto map = checked(identify::parse_columns(columns));
  auto recordings = checked(identify::read_recordings(kData / file, map, start.limits));
  keep_first(recordings.front().rows / 2, recordings.front());
  Recorded recorded;
  recorded.machine = checked(identify::identify({recordings.front()}, start, {})).machine;
  recorded.machine.period = start.period;
  recorded.machine.table.is_identified = true;
  recorded.first = checked(read_tracks(kData / file, map, recorded.machine)).front();
  recorded.second = recorded.first;
  const auto middle = static_cast<std::ptrdiff_t>(recorded.first.samples.size() / 2);
  recorded.first.samples.resize(recorded.first.samples.size() / 2);
  recorded.second.samples.erase(recorded.second.samples.begin(),
                                recorded.second.samples.begin() + middle);
  recorded.baseline = checked(twin::shadow::learn(recorded.machine, {recorded.first}, false));
  return recorded;
}

/// The same motion, with more drive command and force from a time on.
Track with_more_force(Track track, double from) {
  for (auto& sample : track.samples) {
    for (auto& axis : sample.axis) {
      axis.volts *= sample.time >= from ? kMore : 1.0;
      axis.force *= sample.time >= from ? kMore : 1.0;
    }
  }
  return track;
}

Shadow watched(const Recorded& recorded, const Track& track) {
  Shadow shadow(recorded.machine, recorded.baseline, false, 1000.0, track.recorded);
  for (const auto& sample : track.samples) {
    shadow.step(sample);
  }
  EXPECT_FALSE(shadow.has_failed());
  return shadow;
}

class MeasuredShadow : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kData / "emps.csv")) {
      GTEST_SKIP() << "no recordings of real machines in ../shared/data";
    }
  }
};

TEST_F(MeasuredShadow, EmpsIsSilentInItsHealthyHalfAndShowsAFifthMoreForce) {
  config::MachineFile start = start_machine(0.001);
  start.table.axis[hal::kX].drive.mode = hal::mujoco::DriveMode::kTorque;
  start.table.axis[hal::kX].drive.force_scale = 35.15;
  const Recorded emps = learn_half("emps.csv", kEmps, start);
  const Shadow healthy = watched(emps, emps.second);
  ASSERT_NE(healthy.axis(hal::kX), nullptr);
  EXPECT_FALSE(healthy.axis(hal::kX)->finding());
  const Shadow changed = watched(emps, with_more_force(emps.second, kEmpsChange));
  const auto found = changed.axis(hal::kX)->finding();
  ASSERT_TRUE(found);
  EXPECT_GE(found->noticed.time, kEmpsChange);
  EXPECT_NEAR(found->cause.since.time, kEmpsChange, 1.0);
  EXPECT_TRUE(found->cause.cause == twin::shadow::Cause::kInertia ||
              found->cause.cause == twin::shadow::Cause::kVrefGain ||
              found->cause.cause == twin::shadow::Cause::kMotorForce)
      << twin::shadow::to_line(*found, hal::kX);
}

/// Of its two axes Y moves in the first half only and X in the second only, so that nothing that was
/// learnt can be held against a motion; the shadow must not make something up.
TEST_F(MeasuredShadow, SinumerikIsSilentInItsHealthyHalf) {
  const Recorded machine = learn_half("sinumerik_840d.csv", kSinumerik, start_machine(0.002));
  const Shadow healthy = watched(machine, machine.second);
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (healthy.axis(axis) != nullptr) {
      EXPECT_FALSE(healthy.axis(axis)->finding()) << axis;
    }
  }
}

}  // namespace measured_shadow_test
}  // namespace twin::studies::shadow
