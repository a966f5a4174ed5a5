#include "path/segment_writer.hpp"

#include <gtest/gtest.h>

#include "tests/path/smooth_path.hpp"

namespace twin::path {
namespace segment_writer_test {

/// A straight piece along X.
geometry::SpanCubic straight(double begin, double end) {
  return {begin, end, {begin, 0, 0}, {1, 0, 0}, Vec3::Zero(), Vec3::Zero()};
}

BlockDemand block(double end, double feedrate, std::int64_t number) {
  BlockDemand demand;
  demand.end = end;
  demand.feedrate = feedrate;
  demand.number = number;
  return demand;
}

class SegmentWriterTest : public ::testing::Test {
 protected:
  std::vector<Segment> segments;
  SegmentWriter writer{[this](Segment&& segment) { segments.push_back(std::move(segment)); }};
};

TEST_F(SegmentWriterTest,
       AnEndOfABlockThatFollowsASegmentWithinATenthOfAMicrometreReadsNoBlockBeyondTheLast) {
  writer.add_block(block(1.0, 10.0, 0));
  writer.cubic(straight(0.0, 1.0 - 5e-5), 0.0);
  writer.end_curve();  // the block counts as ended here
  writer.cubic(straight(1.0 - 5e-5, 1.0), 0.0);
  writer.finish();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].feedrate, 10.0);
  ASSERT_EQ(segments[1].marks.size(), 1U);
  EXPECT_EQ(segments[1].marks[0].block, 0);
}

TEST_F(SegmentWriterTest, TheRestOfABlockKeepsItsFeedrateWhereAFasterBlockFollows) {
  writer.add_block(block(1.0, 10.0, 0));
  writer.cubic(straight(0.0, 1.0 - 5e-5), 0.0);
  writer.end_curve();
  writer.cubic(straight(1.0 - 5e-5, 1.0), 0.0);
  writer.add_block(block(2.0, 50.0, 1));
  writer.cubic(straight(1.0, 2.0), 0.0);
  writer.finish();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(segments[1].feedrate, 10.0);
  EXPECT_EQ(segments[2].feedrate, 50.0);
  EXPECT_EQ(segments[2].marks[0].block, 1);
}

// A block with a speck behind it, whose end is the same, and a slow block after both: the piece over
// all of them was the slow block's from its begin on.
TEST_F(SegmentWriterTest, APieceIsDividedWhereTheFeedrateChangesBehindABlockOfNoLength) {
  writer.add_block(block(1.0, 50.0, 0));
  writer.add_block(block(1.0, 50.0, 1));
  writer.add_block(block(2.0, 10.0, 2));
  writer.cubic(straight(0.0, 0.5), 0.0);
  writer.cubic(straight(0.5, 1.5), 0.0);
  writer.cubic(straight(1.5, 2.0), 0.0);
  writer.finish();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].feedrate, 50.0);
  EXPECT_NEAR(segments[0].length, 1.0, 1e-9);
  EXPECT_EQ(segments[1].feedrate, 10.0);
  EXPECT_NEAR(segments[1].length, 1.0, 1e-9);
}

TEST_F(SegmentWriterTest, BlocksThatACurveEndsTogetherAreNotReadAfterwards) {
  constexpr int kBlocks = 400;
  for (int i = 0; i < kBlocks; ++i) {  // 1 nm each, with changing demands
    writer.add_block(block(1e-6 * (i + 1), 10.0 + i % 2, i));
  }
  writer.add_block(block(1.0, 10.0, kBlocks));
  for (int i = 0; i < kBlocks; ++i) {
    writer.cubic(straight(1e-6 * i, 1e-6 * (i + 1)), 0.0);
  }
  writer.cubic(straight(1e-6 * kBlocks, 1.0), 0.0);
  writer.finish();
  ASSERT_FALSE(segments.empty());
  EXPECT_EQ(segments.back().marks.back().block, kBlocks);
}

}  // namespace segment_writer_test
}  // namespace twin::path
