#include "results/trace/csv_trace.hpp"

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <limits>
#include <random>

#include "results/trace/columns.hpp"
#include "results/trace/csv_reader.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace csv_trace_test {

using test::content;
using test::TempFolder;

std::optional<Error> begin(CsvTrace& trace, Layout layout) {
  return trace.begin(trace_header(layout, 0.001));
}

std::optional<Error> write(CsvTrace& trace, Layout layout, const Sample& sample,
                           double contour_error = 0.0) {
  std::vector<double> row;
  append_row(sample, contour_error, layout, row);
  return trace.rows(row);
}

TEST(CsvTrace, HeaderAndRowAreExactlyTheInterface) {
  const TempFolder directory;
  CsvTrace trace(directory.path());
  ASSERT_FALSE(begin(trace, Layout::kRun));
  Sample sample;
  sample.t = 3 * 0.001;
  sample.segment = 2;
  sample.line = 17;
  sample.command = {1.5, -2.25, -0.0};
  sample.feedrate = 50.0;
  sample.encoder = {1.25, -2.5};
  sample.table = {1.125, -2.125};
  sample.volts = {0.5, -0.5};
  ASSERT_FALSE(write(trace, Layout::kRun, sample, 0.25));
  ASSERT_FALSE(trace.commit());
  EXPECT_EQ(content(directory.path() / "trace.csv"),
            "t_s,segment,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s,x_enc_mm,y_enc_mm,"
            "x_table_mm,y_table_mm,x_drive_V,y_drive_V,contour_error_um,x_tracking_error_um,"
            "y_tracking_error_um\n"
            "0.003,2,17,1.5,-2.25,0,50,1.25,-2.5,1.125,-2.125,0.5,-0.5,250,250,250\n");
}

TEST(CsvTrace, APlanHasTheFirstSevenColumns) {
  const TempFolder directory;
  CsvTrace trace(directory.path());
  ASSERT_FALSE(begin(trace, Layout::kPlan));
  ASSERT_FALSE(write(trace, Layout::kPlan, Sample{}));
  ASSERT_FALSE(trace.commit());
  EXPECT_EQ(content(directory.path() / "trace.csv"),
            "t_s,segment,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s\n0,0,0,0,0,0,0\n");
}

TEST(CsvTrace, CountsAreWrittenAsWholeNumbers) {
  const TempFolder directory;
  CsvTrace trace(directory.path());
  ASSERT_FALSE(begin(trace, Layout::kPlan));
  Sample sample;
  sample.segment = 100000;
  sample.line = 3000000000;
  sample.feedrate = 100000.0;
  ASSERT_FALSE(write(trace, Layout::kPlan, sample));
  ASSERT_FALSE(trace.commit());
  EXPECT_THAT(content(directory.path() / "trace.csv"),
              testing::EndsWith("\n0,100000,3000000000,0,0,0,1e+05\n"));
}

TEST(CsvTrace, WithoutCommitTheRowsAreThePartialTrace) {
  const TempFolder directory;
  {
    CsvTrace trace(directory.path());
    ASSERT_FALSE(begin(trace, Layout::kPlan));
    ASSERT_FALSE(write(trace, Layout::kPlan, Sample{}));
  }
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "trace.csv"));
  EXPECT_THAT(content(directory.path() / "trace.partial.csv"),
              testing::EndsWith("\n0,0,0,0,0,0,0\n"));
}

TEST(CsvTrace, ACommitReplacesThePartialTraceOfAnEarlierRun) {
  const TempFolder directory;
  test::put(directory.path() / "trace.partial.csv", std::string(100000, '7'));
  CsvTrace trace(directory.path());
  ASSERT_FALSE(begin(trace, Layout::kPlan));
  ASSERT_FALSE(trace.commit());
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "trace.partial.csv"));
  EXPECT_THAT(content(directory.path() / "trace.csv"), testing::EndsWith("feedrate_mm_per_s\n"));
}

/// Any finite double: random bits, so that all exponents and denormals occur.
double any_finite(std::mt19937_64& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) {
      return value;
    }
  }
}

TEST(CsvTrace, EveryDoubleReadsBackBitForBit) {
  const TempFolder directory;
  constexpr std::array<std::string_view, 3> kNames{"a", "b", "c"};
  auto file = CsvFile::create(directory.path() / "a.csv", directory.path() / "a.tmp", kNames);
  ASSERT_TRUE(file);
  std::mt19937_64 random(1);
  std::vector<std::array<double, 3>> rows;
  using Limits = std::numeric_limits<double>;
  rows.push_back({Limits::max(), Limits::denorm_min(), Limits::lowest()});
  for (int i = 0; i < 20000; ++i) {
    rows.push_back({any_finite(random), any_finite(random), i * 0.001});
  }
  for (const auto& row : rows) {
    ASSERT_TRUE(file->write(row));
  }
  ASSERT_TRUE(file->commit());
  auto reader = CsvReader::open(directory.path() / "a.csv");
  ASSERT_TRUE(reader);
  std::array<double, 3> got{};
  for (const auto& row : rows) {
    const auto has_row = reader->next(got);
    ASSERT_TRUE(has_row) << to_string(has_row.error());
    ASSERT_TRUE(*has_row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(got[i]), std::bit_cast<std::uint64_t>(row[i] + 0.0));
    }
  }
  EXPECT_FALSE(*reader->next(got));
}

TEST(CsvTrace, UnwritableDirectoryIsAnErrorWithItsName) {
  CsvTrace trace("/nonexistent");
  const auto error = begin(trace, Layout::kRun);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->file, "/nonexistent/trace.partial.csv");
  EXPECT_EQ(error->code, ErrorCode::kFile);
}

}  // namespace csv_trace_test
}  // namespace twin::results
