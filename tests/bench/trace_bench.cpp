#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <vector>

#include "results/trace/columns.hpp"
#include "results/trace/csv_trace.hpp"
#include "results/trace/hdf5_trace.hpp"
#include "results/trace/trace_reader.hpp"
#include "tests/support/temp_folder.hpp"

// Writing and reading a trace of 16 columns, as CSV and as HDF5.
namespace twin::results {
namespace {

constexpr std::size_t kRows = 200000;

/// Rows as a machine on a wavy path gives them: smooth set points, encoders of 0.1 um a count, noise
/// of some um, and errors that follow from them.
std::vector<double> rows_of_a_run() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 2e-3);  // [mm]
  std::vector<double> rows;
  for (std::size_t i = 0; i < kRows; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const double x = 40.0 * std::sin(0.7 * t) + 3.0 * std::sin(5.0 * t);
    const double y = 40.0 * std::cos(0.6 * t);
    const double table_x = x + noise(random);
    const double table_y = y + noise(random);
    const double encoder_x = 1e-4 * std::round(1e4 * table_x);
    const double encoder_y = 1e-4 * std::round(1e4 * table_y);
    const auto block = static_cast<double>(i / 40);
    for (const double value :
         {t, std::floor(block / 4.0), block + 3.0, x, y, 0.0, 50.0 - 10.0 * std::sin(t), encoder_x,
          encoder_y, table_x, table_y, 0.1 * (x - table_x), 0.1 * (y - table_y),
          1e3 * std::hypot(x - encoder_x, y - encoder_y), 1e3 * (x - encoder_x),
          1e3 * (y - encoder_y)}) {
      rows.push_back(value);
    }
  }
  return rows;
}

void write(TraceSink& sink, const std::vector<double>& rows) {
  constexpr std::size_t kTurn = 1000 * kColumns.size();  // as many as the recorder hands on
  static_cast<void>(sink.begin(trace_header(Layout::kRun, 1e-3)));
  for (std::size_t begin = 0; begin < rows.size(); begin += kTurn) {
    static_cast<void>(
        sink.rows(std::span(rows).subspan(begin, std::min(kTurn, rows.size() - begin))));
  }
  static_cast<void>(sink.commit());
}

template <class MakeSink>
void time_writing(benchmark::State& state, const char* name, const MakeSink& make) {
  const std::vector<double> rows = rows_of_a_run();
  const test::TempFolder folder;
  for (auto _ : state) {
    auto sink = make(folder.path());
    write(sink, rows);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kRows));
  state.counters["bytes_a_row"] =
      static_cast<double>(std::filesystem::file_size(folder.path() / name)) / kRows;
}

void write_csv(benchmark::State& state) {
  time_writing(state, "trace.csv", [](const std::filesystem::path& folder) {
    return CsvTrace(folder, Durability::kCached);
  });
}
void write_hdf5(benchmark::State& state) {
  time_writing(state, "trace.h5", [](const std::filesystem::path& folder) {
    return Hdf5Trace(folder, {}, Durability::kCached);
  });
}
BENCHMARK(write_csv)->Unit(benchmark::kMillisecond);
BENCHMARK(write_hdf5)->Unit(benchmark::kMillisecond);

template <class Sink>
void time_reading(benchmark::State& state, Sink&& sink, const std::filesystem::path& file) {
  write(sink, rows_of_a_run());
  constexpr std::array<std::string_view, 3> kWanted{"t_s", "x_enc_mm", "y_enc_mm"};
  for (auto _ : state) {
    double sum = 0.0;
    static_cast<void>(
        read_rows(file, kWanted, [&sum](std::span<const double> row) { sum += row[1]; }));
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kRows));
}

void read_three_columns_of_csv(benchmark::State& state) {
  const test::TempFolder folder;
  time_reading(state, CsvTrace(folder.path(), Durability::kCached), folder.path() / "trace.csv");
}
void read_three_columns_of_hdf5(benchmark::State& state) {
  const test::TempFolder folder;
  time_reading(state, Hdf5Trace(folder.path(), {}, Durability::kCached),
               folder.path() / "trace.h5");
}
BENCHMARK(read_three_columns_of_csv)->Unit(benchmark::kMillisecond);
BENCHMARK(read_three_columns_of_hdf5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace twin::results
