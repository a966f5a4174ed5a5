#include "results/trace/limit_writer.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace limit_writer_test {

TEST(LimitWriter, KeepsBothEndsOfEveryConstantStretch) {
  const test::TempFolder directory;
  auto writer = LimitWriter::create(directory.path());
  ASSERT_TRUE(writer);
  double t = 0.0;
  for (const double limit : {50.0, 50.0, 50.0, 20.0, 30.0, 30.0}) {
    ASSERT_TRUE(writer->write(t, limit));
    t += 0.5;
  }
  ASSERT_TRUE(writer->write(t, std::numeric_limits<double>::infinity()));
  ASSERT_TRUE(writer->commit());
  EXPECT_EQ(test::content(directory.path() / "feedrate_limit.csv"),
            "t_s,feedrate_limit_mm_per_s\n0,50\n1,50\n1.5,20\n2,30\n2.5,30\n");
}

}  // namespace limit_writer_test
}  // namespace twin::results
