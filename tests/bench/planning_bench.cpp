#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

/// Read to planned segment, on one core; the reader alone is the reference beside it.
namespace twin::runtime {
namespace {

/// A wavy closed path of short blocks [mm], 4 decimals as CAM writes them.
std::string wavy_program(std::int64_t blocks, double block_length) {
  std::string text = "G21 G90 G17 G64\nG01 F3000\n";
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  for (std::int64_t i = 0; i < blocks; ++i) {
    const double s = block_length * static_cast<double>(i);
    heading += block_length * (0.12 * std::sin(s / 7.0) + 0.02);
    x += block_length * std::cos(heading);
    y += block_length * std::sin(heading);
    text += fmt::format("X{:.4f} Y{:.4f}\n", x, y);
  }
  return text + "M30\n";
}

void count_blocks(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void read_only(benchmark::State& state) {
  const std::string text = wavy_program(state.range(0), 0.26);
  for (auto _ : state) {
    gcode::Reader reader = gcode::Reader::from_text(text, "bench.nc");
    for (auto block = reader.next(); block && block->has_value(); block = reader.next()) {
      benchmark::DoNotOptimize(block);
    }
  }
  count_blocks(state);
}

void read_to_planned(benchmark::State& state, double block_length, CurveKind curves,
                     Planner planner = Planner::kPaper) {
  const std::string text = wavy_program(state.range(0), block_length);
  config::MachineFile machine;
  machine.path.curves = curves;
  machine.path.planner = planner;
  for (auto _ : state) {
    gcode::Reader reader = gcode::Reader::from_text(text, "bench.nc");
    auto figures = plan_program(reader, machine, [](feedrate::PlannedSegment&& planned) {
      benchmark::DoNotOptimize(planned);
      return true;
    });
    if (!figures || figures->fallbacks != 0) {
      state.SkipWithError("the program could not be planned");
    }
  }
  count_blocks(state);
}

BENCHMARK(read_only)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, curves_0_26_mm, 0.26, CurveKind::kNurbs)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, curves_0_02_mm, 0.02, CurveKind::kNurbs)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, lines_0_26_mm, 0.26, CurveKind::kNone)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(read_to_planned, certified_0_26_mm, 0.26, CurveKind::kNurbs, Planner::kCertified)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, certified_lines_0_26_mm, 0.26, CurveKind::kNone,
                  Planner::kCertified)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace twin::runtime
