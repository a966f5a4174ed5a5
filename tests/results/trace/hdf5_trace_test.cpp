#include "results/trace/hdf5_trace.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "results/trace/trace_files.hpp"
#include "results/trace/trace_reader.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace hdf5_trace_test {

namespace fs = std::filesystem;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

const TraceHeader kHeader{.columns = {{.name = "t_s", .unit = "s", .long_name = "time"},
                                      {.name = "line", .kind = TraceColumn::Kind::kWhole},
                                      {.name = "x_mm", .unit = "mm", .long_name = "position"}},
                          .period = 1e-3};

double x_of(std::size_t row) {
  return row % 7 == 0 ? -0.0 : std::sin(0.37 * static_cast<double>(row)) * 40.0;
}

std::vector<double> rows_of(std::size_t count) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.insert(rows.end(), {1e-3 * static_cast<double>(i), static_cast<double>(i / 10), x_of(i)});
  }
  return rows;
}

void expect_none(const std::optional<Error>& error) { EXPECT_FALSE(error) << to_string(*error); }

void write(const fs::path& folder, std::size_t count) {
  Hdf5Trace trace(folder, {.program = "a.nc", .program_sha256 = "12ab", .settings = "[limits]\n"});
  expect_none(trace.begin(kHeader));
  const std::vector<double> rows = rows_of(count);
  for (std::size_t begin = 0; begin < rows.size(); begin += 900) {
    expect_none(trace.rows(
        std::span(rows).subspan(begin, std::min<std::size_t>(900, rows.size() - begin))));
  }
  trace.set_summary("{\"program\": \"a.nc\"}\n");
  expect_none(trace.commit());
}

std::vector<std::vector<double>> read(const fs::path& file) {
  constexpr std::array<std::string_view, 3> kNames{"x_mm", "line", "t_s"};
  std::vector<std::vector<double>> rows;
  const auto done = read_rows(file, kNames, [&rows](std::span<const double> row) {
    rows.emplace_back(row.begin(), row.end());
  });
  EXPECT_TRUE(done) << to_string(done.error());
  return rows;
}

std::string complaint(const fs::path& file, std::string_view column = "t_s") {
  const auto done = read_rows(file, std::array{column}, [](std::span<const double>) {});
  return done ? std::string() : to_string(done.error());
}

TEST(Hdf5Trace, EveryNumberComesBack) {
  for (const std::size_t count : {std::size_t{1}, kHdf5ChunkRows, 3 * kHdf5ChunkRows + 77}) {
    const TempFolder folder;
    write(folder.path(), count);
    EXPECT_FALSE(fs::exists(folder.path() / "trace.partial.h5"));
    const auto rows = read(folder.path() / "trace.h5");
    ASSERT_EQ(rows.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_THAT(rows[i],
                  ElementsAre(x_of(i), static_cast<double>(i / 10), 1e-3 * static_cast<double>(i)));
      ASSERT_FALSE(std::signbit(rows[i][0]) && rows[i][0] == 0.0) << "-0 is written as 0";
    }
  }
}

TEST(Hdf5Trace, WithoutRowsItIsEmpty) {
  const TempFolder folder;
  write(folder.path(), 0);
  EXPECT_TRUE(read(folder.path() / "trace.h5").empty());
}

TEST(Hdf5Trace, TheSameRowsAreTheSameBytes) {
  const TempFolder a;
  const TempFolder b;
  write(a.path(), 10000);
  write(b.path(), 10000);
  EXPECT_EQ(test::content(a.path() / "trace.h5"), test::content(b.path() / "trace.h5"));
}

TEST(Hdf5Trace, ARunThatFailsLeavesItsRowsAsPartial) {
  const TempFolder folder;
  Hdf5Trace trace(folder.path(), {});
  expect_none(trace.begin(kHeader));
  expect_none(trace.rows(rows_of(100)));
  trace.abandon();
  EXPECT_FALSE(fs::exists(folder.path() / "trace.h5"));
  EXPECT_EQ(read(folder.path() / "trace.partial.h5").size(), 100U);
}

TEST(Hdf5Trace, WhatIsFlushedCanBeReadWhileTheRunGoesOn) {
  const TempFolder folder;
  Hdf5Trace trace(folder.path(), {});
  expect_none(trace.begin(kHeader));
  expect_none(trace.rows(rows_of(2 * kHdf5ChunkRows + 5)));
  fs::copy(folder.path() / "trace.partial.h5", folder.path() / "killed.h5");  // as after SIGKILL
  EXPECT_EQ(read(folder.path() / "killed.h5").size(), 2 * kHdf5ChunkRows);
  trace.abandon();
}

TEST(Hdf5Trace, AFileCutShortIsNamed) {
  const TempFolder folder;
  write(folder.path(), 5000);
  const fs::path file = folder.path() / "trace.h5";
  for (const std::uintmax_t size :
       {fs::file_size(file) - 1, std::uintmax_t{3000}, std::uintmax_t{9}}) {
    fs::resize_file(file, size);
    EXPECT_THAT(complaint(file), HasSubstr("trace.h5: cannot read this HDF5 file, which may be cut "
                                           "short"));
  }
}

TEST(Hdf5Trace, DamagedBytesAreAnErrorOrNumbers) {
  const TempFolder folder;
  write(folder.path(), 5000);
  const std::string whole = test::content(folder.path() / "trace.h5");
  for (std::size_t at = 8; at < whole.size(); at += 997) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    test::put(folder.path() / "damaged.h5", damaged);
    static_cast<void>(complaint(folder.path() / "damaged.h5", "x_mm"));  // neither crash nor hang
  }
}

TEST(Hdf5Trace, AMissingColumnIsNamedWithThoseThereAre) {
  const TempFolder folder;
  write(folder.path(), 10);
  EXPECT_THAT(complaint(folder.path() / "trace.h5", "y_mm"),
              HasSubstr("no column y_mm; there are: line,t_s,x_mm"));
}

TEST(Hdf5Trace, WhatIsNoNumberIsNamedWithItsRow) {
  const TempFolder folder;
  Hdf5Trace trace(folder.path(), {});
  expect_none(trace.begin(kHeader));
  expect_none(trace.rows(std::vector<double>{0.0, 1.0, 2.0}));
  expect_none(trace.rows(std::vector<double>{1.0, 1.0, std::numeric_limits<double>::infinity()}));
  expect_none(trace.commit());
  EXPECT_THAT(complaint(folder.path() / "trace.h5", "x_mm"),
              HasSubstr("row 2: inf in column x_mm is not a finite number"));
}

TEST(Hdf5Trace, ASymbolicLinkIsNotWrittenThrough) {
  const TempFolder folder;
  test::put(folder.path() / "mine", "mine");
  fs::create_symlink(folder.path() / "mine", folder.path() / "trace.partial.h5");
  Hdf5Trace trace(folder.path(), {});
  EXPECT_TRUE(trace.begin(kHeader));
  EXPECT_EQ(test::content(folder.path() / "mine"), "mine");
}

TEST(TraceFiles, TheNewestTraceOfAFolderIsFound) {
  const TempFolder folder;
  EXPECT_EQ(find_trace(folder.path()), folder.path() / "trace.csv");
  const auto put_at = [&folder](std::string_view name, int seconds) {
    test::put(folder.path() / name, "x");
    fs::last_write_time(folder.path() / name, fs::file_time_type{} + std::chrono::seconds(seconds));
  };
  put_at("trace.h5", 5);
  EXPECT_EQ(find_trace(folder.path()).filename(), "trace.h5");
  put_at("trace.csv", 5);
  EXPECT_EQ(find_trace(folder.path()).filename(), "trace.csv");
  put_at("trace.partial.h5", 6);
  EXPECT_EQ(find_trace(folder.path()).filename(), "trace.partial.h5");
}

}  // namespace hdf5_trace_test
}  // namespace twin::results
