#include "results/trace/decimator.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace decimator_test {

/// Index, smooth signal, noise with rare spikes; watched are the last two.
std::array<double, 3> row_at(std::size_t i, std::mt19937& random) {
  const double noise = std::normal_distribution<double>(0.0, 1.0)(random);
  const double spike = random() % 5000 == 0 ? 50.0 * noise : 0.0;
  return {static_cast<double>(i), std::sin(1e-4 * static_cast<double>(i)), noise + spike};
}

TEST(Decimator, FewRowsAreAllKept) {
  Decimator decimator(3, {1, 2}, 100);
  std::mt19937 random(1);
  std::vector<double> all;
  for (std::size_t i = 0; i < 100; ++i) {
    const auto row = row_at(i, random);
    all.insert(all.end(), row.begin(), row.end());
    decimator.push(row);
  }
  EXPECT_EQ(decimator.finish().values, all);
}

TEST(Decimator, BoundedRowsInOrderWithAllExtremesFirstAndLast) {
  for (const std::size_t count : {101U, 128U, 1000U, 99999U, 262144U}) {
    std::mt19937 random(2);
    Decimator decimator(3, {1, 2}, 100);
    std::array<double, 2> low{1e300, 1e300};
    std::array<double, 2> high{-1e300, -1e300};
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = row_at(i, random);
      for (std::size_t c = 0; c < 2; ++c) {
        low[c] = std::fmin(low[c], row[c + 1]);
        high[c] = std::fmax(high[c], row[c + 1]);
      }
      decimator.push(row);
    }
    const Table table = decimator.finish();
    ASSERT_LE(table.rows(), 100U);
    ASSERT_GE(table.rows(), 20U);
    EXPECT_EQ(table.at(0, 0), 0.0);
    EXPECT_EQ(table.at(table.rows() - 1, 0), static_cast<double>(count - 1));
    std::array<double, 2> kept_low{1e300, 1e300};
    std::array<double, 2> kept_high{-1e300, -1e300};
    for (std::size_t i = 0; i < table.rows(); ++i) {
      ASSERT_TRUE(i == 0 || table.at(i, 0) > table.at(i - 1, 0));
      for (std::size_t c = 0; c < 2; ++c) {
        kept_low[c] = std::fmin(kept_low[c], table.at(i, c + 1));
        kept_high[c] = std::fmax(kept_high[c], table.at(i, c + 1));
      }
    }
    EXPECT_EQ(kept_low, low);
    EXPECT_EQ(kept_high, high);
  }
}

TEST(Decimator, KeptRowsAreRowsOfTheStream) {
  Decimator decimator(3, {1, 2}, 50);
  std::mt19937 random(3);
  std::vector<std::array<double, 3>> all;
  for (std::size_t i = 0; i < 5000; ++i) {
    all.push_back(row_at(i, random));
    decimator.push(all.back());
  }
  const Table table = decimator.finish();
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_THAT(table.row(i),
                testing::ElementsAreArray(all[static_cast<std::size_t>(table.at(i, 0))]));
  }
}

TEST(LoadDecimated, ReadsNamedColumnsOfATrace) {
  const test::TempFolder directory;
  const test::SyntheticRun run;
  const auto rows = test::write_synthetic_trace(directory.path(), run);
  ASSERT_TRUE(rows);
  constexpr std::array<std::string_view, 2> kWanted{"t_s", "x_cmd_mm"};
  const auto all = load_decimated(directory.path() / "trace.csv", kWanted, 10000);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->rows(), static_cast<std::size_t>(*rows));
  EXPECT_EQ(all->at(1000, 0), 1.0);
  EXPECT_EQ(all->at(1000, 1), test::trefoil(run, 1.0).x());
  const auto few = load_decimated(directory.path() / "trace.csv", kWanted, 200);
  ASSERT_TRUE(few);
  EXPECT_LE(few->rows(), 200U);
}

}  // namespace decimator_test
}  // namespace twin::results
