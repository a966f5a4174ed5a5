#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "feedrate/planner.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "runtime/program_bound.hpp"
#include "tests/bench/peak_memory.hpp"
#include "tests/bench/wavy_file.hpp"

/// Read to planned segment, on one core and from a file, so that no program is held in memory; the
/// reader alone is the reference beside it. `beside` is on all cores, with rates of wall clock and
/// the CPU time of all threads.
///
/// Counters: blocks/s, time of one block, peak resident memory of the process in this benchmark.
namespace twin::runtime {
namespace {

void report(benchmark::State& state, std::int64_t peak_bytes) {
  const auto blocks = static_cast<double>(state.iterations() * state.range(0));
  state.counters["blocks/s"] = benchmark::Counter(blocks, benchmark::Counter::kIsRate);
  state.counters["s/block"] =
      benchmark::Counter(blocks, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["peak_MiB"] = static_cast<double>(peak_bytes) / (1024.0 * 1024.0);
}

void read_only(benchmark::State& state) {
  const bench::WavyFile file(state.range(0), 0.26);
  bench::reset_peak_memory();
  for (auto _ : state) {
    auto reader = gcode::Reader::open(file.path().string());
    for (auto block = reader->next(); block && block->has_value(); block = reader->next()) {
      benchmark::DoNotOptimize(block);
    }
  }
  report(state, bench::peak_memory());
}

void read_to_planned(benchmark::State& state, double block_length, Planner planner,
                     CurveKind curves, bench::PathShape shape = bench::PathShape::kWavy,
                     PlanThreads threads = PlanThreads::kOne) {
  const bench::WavyFile file(state.range(0), block_length, shape);
  config::MachineFile machine;
  machine.path.planner = planner;
  machine.path.curves = curves;
  bench::reset_peak_memory();
  for (auto _ : state) {
    auto reader = gcode::Reader::open(file.path().string());
    auto figures = plan_program(
        *reader, machine,
        [](feedrate::PlannedSegment&& planned) {
          benchmark::DoNotOptimize(planned);
          return true;
        },
        {}, threads);
    if (!figures || figures->fallbacks != 0) {
      state.SkipWithError("the program could not be planned");
    }
  }
  report(state, bench::peak_memory());
}

/// Blocks that were read before to segments: the path builder alone.
void blocks_to_path(benchmark::State& state, double block_length, Planner planner) {
  const bench::WavyFile file(state.range(0), block_length);
  auto reader = gcode::Reader::open(file.path().string());
  std::vector<gcode::Block> blocks;
  for (auto block = reader->next(); block && block->has_value(); block = reader->next()) {
    blocks.push_back(**block);
  }
  config::MachineFile machine;
  machine.path.planner = planner;
  bench::reset_peak_memory();
  for (auto _ : state) {
    const auto builder =
        feedrate::make_planner(machine.limits, machine.planning, machine.path, machine.period)
            ->make_builder([](path::Segment&& segment) { benchmark::DoNotOptimize(segment); });
    for (const gcode::Block& block : blocks) {
      builder->push(block);
    }
    builder->finish();
  }
  report(state, bench::peak_memory());
}

void read_to_bound(benchmark::State& state) {
  const bench::WavyFile file(state.range(0), 0.26);
  const config::MachineFile machine;
  bench::reset_peak_memory();
  for (auto _ : state) {
    auto bound =
        gcode::ProgramText::read(file.path()).and_then([&](const gcode::ProgramText& text) {
          return time_bound(text, machine, {});
        });
    benchmark::DoNotOptimize(bound);
  }
  report(state, bench::peak_memory());
}

constexpr std::int64_t kFewest = 1000;
constexpr std::int64_t kMost = 10000000;

BENCHMARK(read_only)->RangeMultiplier(10)->Range(kFewest, kMost)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, paper_0_26_mm, 0.26, Planner::kPaper, CurveKind::kNurbs)
    ->RangeMultiplier(10)
    ->Range(kFewest, kMost)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, certified_0_26_mm, 0.26, Planner::kCertified, CurveKind::kNurbs)
    ->RangeMultiplier(10)
    ->Range(kFewest, kMost)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, certified_zigzag, 0.1, Planner::kCertified, CurveKind::kNurbs,
                  bench::PathShape::kZigzag)
    ->RangeMultiplier(10)
    ->Range(kFewest, kMost)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, beside_0_26_mm, 0.26, Planner::kCertified, CurveKind::kNurbs,
                  bench::PathShape::kWavy, PlanThreads::kBeside)
    ->RangeMultiplier(10)
    ->Range(kFewest, kMost)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, beside_zigzag, 0.1, Planner::kCertified, CurveKind::kNurbs,
                  bench::PathShape::kZigzag, PlanThreads::kBeside)
    ->RangeMultiplier(10)
    ->Range(kFewest, kMost)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, paper_0_02_mm, 0.02, Planner::kPaper, CurveKind::kNurbs)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, certified_0_02_mm, 0.02, Planner::kCertified, CurveKind::kNurbs)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_to_planned, paper_lines_0_26_mm, 0.26, Planner::kPaper, CurveKind::kNone)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks_to_path, paper_0_26_mm, 0.26, Planner::kPaper)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks_to_path, certified_0_26_mm, 0.26, Planner::kCertified)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks_to_path, certified_0_02_mm, 0.02, Planner::kCertified)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(read_to_bound)
    ->RangeMultiplier(10)
    ->Range(kFewest, 1000000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace twin::runtime
