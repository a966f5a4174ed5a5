#include "studies/search/cma_es.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "studies/identify/search_checkpoint.hpp"
#include "studies/search/minimise.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::search {
namespace cma_es_test {

using identify::read_checkpoint;
using identify::write_checkpoint;
/// An ellipsoid whose axes differ by a factor of 100, turned; 0 at 0.4.
double ellipsoid(std::span<const double> x) {
  double sum = 0.0;
  double carried = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    carried = 0.6 * carried + (x[i] - 0.4);
    sum += std::pow(10.0, 4.0 * static_cast<double>(i) / static_cast<double>(x.size() - 1)) *
           carried * carried;
  }
  return sum;
}

MinimiseOptions options_of(std::size_t evaluations) {
  MinimiseOptions options;
  options.start = std::vector<double>(8, 0.9);
  options.evaluations = evaluations;
  options.precision = 0.0;
  return options;
}

TEST(CmaEs, FindsTheMinimumOfATurnedEllipsoidOfCondition1e4) {
  const Minimum found = minimise(ellipsoid, options_of(8000));
  for (const double x : found.x) {
    EXPECT_NEAR(x, 0.4, 1e-4);
  }
}

TEST(CmaEs, TheNumberOfThreadsChangesNothing) {
  MinimiseOptions options = options_of(600);
  const Minimum one = minimise(ellipsoid, options);
  options.threads = 3;
  const Minimum three = minimise(ellipsoid, options);
  EXPECT_EQ(one.x, three.x);
  EXPECT_EQ(one.cost, three.cost);
}

TEST(CmaEs, ASearchThatWasCutOffGoesOnFromItsCheckpointAsIfItHadNotBeen) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "search.checkpoint";
  MinimiseOptions options = options_of(600);
  const Minimum whole = minimise(ellipsoid, options);

  options.evaluations = 250;
  options.save = [&](const SearchState& state) {
    ASSERT_TRUE(write_checkpoint(file, {"ellipsoid", 1, state}));
  };
  minimise(ellipsoid, options);
  const auto read = read_checkpoint(file, "ellipsoid");
  ASSERT_TRUE(read && read->has_value());
  EXPECT_EQ((*read)->stage, 1);
  MinimiseOptions rest = options_of(600);
  rest.resumed = (*read)->state;
  const Minimum resumed = minimise(ellipsoid, rest);
  EXPECT_EQ(resumed.x, whole.x);
  EXPECT_EQ(resumed.cost, whole.cost);
  EXPECT_EQ(resumed.evaluations, whole.evaluations);
}

TEST(SearchCheckpoint, OfAnotherFitOrBrokenIsRefusedAndNoneIsNone) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "search.checkpoint";
  const auto none = read_checkpoint(file, "a");
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->has_value());
  SearchState state{CmaEs::start(std::vector<double>{0.5, 0.5}, 0.1), {{0.5, 0.5}, 1.0, 1, false}};
  ASSERT_TRUE(write_checkpoint(file, {"b", 0, state}));
  const auto other = read_checkpoint(file, "a");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("another fit"), std::string::npos);
  for (const char* const text : {"", "{}", "[1]", "{\"format\": 1}",
                                 "{\"format\": \"twin identify checkpoint 1\", \"fit\": \"a\"}"}) {
    std::ofstream(file) << text;
    EXPECT_FALSE(read_checkpoint(file, "a")) << text;
  }
}

}  // namespace cma_es_test
}  // namespace twin::studies::search
