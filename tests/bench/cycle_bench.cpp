#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "config/machine_file.hpp"
#include "gcode/reader.hpp"
#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/rig_machine.hpp"
#include "runtime/cycle.hpp"
#include "runtime/planning.hpp"

/// Cost of one interpolation period. The position of a curve alone (nurbs_bench) is the reference
/// beside it.
namespace twin::runtime {
namespace {

/// Hands out the same planned segments over and over.
class LoopingSource final : public motion::SegmentSource {
 public:
  explicit LoopingSource(std::vector<feedrate::PlannedSegment>&& plan) : plan_(std::move(plan)) {}
  const feedrate::PlannedSegment* next() noexcept override {
    return &plan_[next_++ % plan_.size()];
  }
  void release(const feedrate::PlannedSegment* /*segment*/) noexcept override {}
  bool is_finished() const noexcept override { return false; }

 private:
  std::vector<feedrate::PlannedSegment> plan_;
  std::size_t next_ = 0;
};

/// A table that is where it was told to be a period ago; costs nothing and is watched.
class PerfectTable final : public hal::Machine {
 public:
  PerfectTable() {
    info_.mm_per_count.fill(0.001);
    info_.mm_per_s_per_volt.fill(100.0);
  }
  const hal::MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double /*period*/) override { return {}; }
  std::optional<Error> activate() override { return {}; }
  hal::Status read(hal::Inputs& inputs) noexcept override {
    for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
      inputs.counts[i] = std::llround(reference_[i] / info_.mm_per_count[i]);
      inputs.servo_ready[i] = true;
    }
    return hal::Status::kOk;
  }
  hal::Status write(const hal::Outputs& outputs) noexcept override {
    reference_ = outputs.position_reference;
    return hal::Status::kOk;
  }
  hal::Truth truth() const noexcept override { return {}; }
  void deactivate() noexcept override {}
  void cleanup() noexcept override {}
  std::string last_error() const override { return {}; }

 private:
  hal::MachineInfo info_;
  std::array<double, 3> reference_{};
};

std::vector<feedrate::PlannedSegment> plan_of_circle() {
  std::string text = "G21 G90 G17 G64\nG01 F3000\n";
  for (int i = 1; i <= 4000; ++i) {
    const double angle = 2.0 * M_PI * i / 1000.0;
    text += fmt::format("X{:.4f} Y{:.4f}\n", 40.0 * std::cos(angle) - 40.0, 40.0 * std::sin(angle));
  }
  std::vector<feedrate::PlannedSegment> plan;
  gcode::Reader reader = gcode::Reader::from_text(text, "bench.nc");
  (void)plan_program(reader, config::MachineFile{}, [&](feedrate::PlannedSegment&& planned) {
    plan.push_back(std::move(planned));
    return true;
  });
  return plan;
}

/// Interpolator alone, on curves of 20 blocks.
void interpolate(benchmark::State& state) {
  LoopingSource source(plan_of_circle());
  motion::Interpolator interpolator(source, 0.001);
  motion::SetPoint set_point;
  for (auto _ : state) {
    benchmark::DoNotOptimize(interpolator.step(set_point));
    benchmark::DoNotOptimize(set_point);
  }
}

/// Interpolator and servo of both axes: the whole cycle but for the machine.
void interpolate_and_servo(benchmark::State& state) {
  LoopingSource source(plan_of_circle());
  motion::Interpolator interpolator(source, 0.001);
  hal::ideal::IdealMachine machine;
  if (!checked(machine.configure(0.001)) || !checked(machine.activate())) {
    state.SkipWithError("no machine");
    return;
  }
  Cycle cycle(interpolator, &machine, config::MachineFile{}.servo, 0.001);
  results::Sample sample;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cycle.prepare());
    benchmark::DoNotOptimize(cycle.exchange(sample));
    benchmark::DoNotOptimize(sample);
  }
}

/// The same with the monitors of both axes.
void interpolate_servo_and_monitors(benchmark::State& state) {
  LoopingSource source(plan_of_circle());
  motion::Interpolator interpolator(source, 0.001);
  PerfectTable machine;
  Cycle cycle(interpolator, &machine, config::MachineFile{}.servo, 0.001);
  results::Sample sample;
  for (auto _ : state) {
    cycle.prepare();
    if (cycle.exchange(sample) != hal::Status::kOk) {
      state.SkipWithError("a monitor tripped");
      return;
    }
    benchmark::DoNotOptimize(sample);
  }
}

/// The whole cycle of the rig on emulated boards that nothing moves: latch, two counters,
/// interpolate, servo, monitors, digital outputs, two converters. What is left out is the bus.
void whole_period_on_the_rig(benchmark::State& state) {
  LoopingSource source(plan_of_circle());
  motion::Interpolator interpolator(source, 0.001);
  namespace rig = hal::rig;
  rig::boards::BoardRegisters boards;
  rig::boards::power_on(boards, 0, 0);
  boards.pci1716.digital_in = 0xFF;  // ready, no alarm, limit switches closed
  const rig::RigSettings settings;
  const auto open = [&] {
    return rig::RegisterCards::open(std::make_unique<rig::boards::EmulatedPci1716>(boards.pci1716),
                                    std::make_unique<rig::boards::EmulatedPci1784>(boards.pci1784),
                                    settings);
  };
  rig::RigMachine machine(settings, {{1e-3, 1e-3}, {100.0, 100.0}}, open);
  if (!checked(machine.configure(0.001))) {
    state.SkipWithError("no machine");
    return;
  }
  motion::SafetySettings blind;  // the table does not follow
  blind.tracking_error = blind.runaway = blind.frozen_encoder = blind.saturation_time = 1e12;
  Cycle cycle(interpolator, &machine, config::MachineFile{}.servo, 0.001, blind);
  results::Sample sample;
  if (!checked(machine.activate()) || cycle.hold() != hal::Status::kOk) {
    state.SkipWithError("no machine");
    return;
  }
  for (auto _ : state) {
    cycle.prepare();
    if (cycle.exchange(sample) != hal::Status::kOk) {
      state.SkipWithError("the rig failed");
      return;
    }
    benchmark::DoNotOptimize(sample);
  }
}

/// With the simulated table: ten physics steps of 0.1 ms a period.
void whole_period_on_the_table(benchmark::State& state) {
  LoopingSource source(plan_of_circle());
  motion::Interpolator interpolator(source, 0.001);
  hal::mujoco::TableParams params;
  params.model = TWIN_SOURCE_DIR "/mjcf/xy_table.xml";
  hal::mujoco::MujocoMachine machine(params);
  if (!checked(machine.configure(0.001)) || !checked(machine.activate())) {
    state.SkipWithError("no machine");
    return;
  }
  Cycle cycle(interpolator, &machine, config::MachineFile{}.servo, 0.001);
  results::Sample sample;
  for (auto _ : state) {
    cycle.prepare();
    if (cycle.exchange(sample) != hal::Status::kOk) {
      state.SkipWithError("the machine failed");
      return;
    }
  }
  state.counters["physics_steps"] = 10;
}

BENCHMARK(interpolate);
BENCHMARK(interpolate_and_servo);
BENCHMARK(interpolate_servo_and_monitors);
BENCHMARK(whole_period_on_the_rig);
BENCHMARK(whole_period_on_the_table);

}  // namespace
}  // namespace twin::runtime
