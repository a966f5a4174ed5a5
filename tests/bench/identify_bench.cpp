#include <benchmark/benchmark.h>

#include <string>

#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/cycle.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/table_run.hpp"

/// Cost of a simulated physics step: one axis without MuJoCo, beside the whole table with it.
namespace twin::studies::identify {
namespace {

constexpr int kSteps = 10;  // physics steps in a period

config::MachineFile machine_file() {
  return config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml")
      .value_or(config::MachineFile());
}

std::vector<motion::SetPoint> set_points(const config::MachineFile& machine) {
  const auto program = gcode::ProgramText::read(TWIN_SOURCE_DIR "/nc_programs/oxalis.nc");
  return plan_set_points(program.value_or(gcode::ProgramText()), machine)
      .value_or(std::vector<motion::SetPoint>());
}

void plain_axis(benchmark::State& state) {
  const config::MachineFile machine = machine_file();
  const auto axis = static_cast<hal::Axis>(state.range(0));
  std::vector<motion::Reference> references;
  for (const motion::SetPoint& point : set_points(machine)) {
    const auto i = static_cast<Eigen::Index>(axis);
    references.push_back({point.position[i], point.velocity[i], point.acceleration[i]});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate(axis_setup(machine, axis), references));
  }
  const auto periods = static_cast<std::int64_t>(references.size()) +
                       static_cast<std::int64_t>(kSettleTime / machine.period);
  state.SetItemsProcessed(state.iterations() * periods * kSteps);
}

/// Both axes; an item is one axis's step, as above.
void mujoco_table(benchmark::State& state) {
  const config::MachineFile machine = machine_file();
  const std::vector<motion::SetPoint> points = set_points(machine);
  std::array<motion::AxisServo, 2> servos{
      motion::AxisServo{machine.servo[0], 83.0, machine.period},
      motion::AxisServo{machine.servo[1], 83.0, machine.period}};
  for (auto _ : state) {
    hal::mujoco::MujocoMachine table(machine.table);
    if (!checked(table.configure(machine.period)) || !checked(table.activate())) {
      state.SkipWithError("no table");
      return;
    }
    hal::Inputs inputs;
    hal::Outputs outputs;
    outputs.servo_on = {true, true};
    for (const motion::SetPoint& point : points) {
      table.read(inputs);
      for (std::size_t a = 0; a < 2; ++a) {
        const auto i = static_cast<Eigen::Index>(a);
        outputs.volts[a] =
            servos[a].update({point.position[i], point.velocity[i], point.acceleration[i]},
                             static_cast<double>(inputs.counts[a]) * 0.01);
      }
      table.write(outputs);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()) * kSteps *
                          2);
}

BENCHMARK(plain_axis)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(mujoco_table)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace twin::studies::identify
