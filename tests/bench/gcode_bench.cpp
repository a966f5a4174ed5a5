#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "gcode/reader.hpp"

namespace twin::gcode {
namespace {

constexpr int kLines = 100000;

/// Short blocks as CAM writes them, 4 decimals.
std::string short_blocks(bool is_verbose) {
  std::string text = "G21 G90 G17\nG01 F3000\n";
  for (int i = 0; i < kLines; ++i) {
    const double x = 40.0 * std::cos(1e-3 * i);
    const double y = 40.0 * std::sin(1e-3 * i);
    text += is_verbose ? fmt::format("N{} G01 X{:.4f} Y{:.4f} Z0.0000 F3000\n", i, x, y)
                       : fmt::format("X{:.4f} Y{:.4f}\n", x, y);
  }
  return text;
}

/// Quarter circles with alternating centres.
std::string quarter_circles() {
  std::string text = "G17 F3000\n";
  for (int i = 0; i < kLines; ++i) {
    text += i % 2 == 0 ? "G02 X1.2500 Y1.2500 I1.2500 J0\n" : "G03 X0 Y0 I0 J-1.2500\n";
  }
  return text;
}

void read_all(benchmark::State& state, const std::string& text) {
  std::int64_t blocks = 0;
  for (auto _ : state) {
    Reader reader = Reader::from_text(text, "bench.nc");
    auto block = reader.next();
    for (; block && *block; block = reader.next()) {
      ++blocks;
    }
    if (!block) {
      state.SkipWithError(to_string(block.error()).c_str());
    }
  }
  state.SetItemsProcessed(blocks);
}

void modal_lines(benchmark::State& state) { read_all(state, short_blocks(false)); }
void verbose_lines(benchmark::State& state) { read_all(state, short_blocks(true)); }
void arcs(benchmark::State& state) { read_all(state, quarter_circles()); }

BENCHMARK(modal_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(verbose_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(arcs)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace twin::gcode
