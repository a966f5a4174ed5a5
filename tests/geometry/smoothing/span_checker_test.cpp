#include "geometry/smoothing/span_checker.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace twin::geometry {
namespace span_checker_test {

/// Keeps where the spans begin that it is given.
class Recorder : public RunSink {
 public:
  void take_span(const SpanCubic& span, double) override { begins.push_back(span.begin); }
  void take_block(const Vec3&, const Vec3&, double, double) override {}
  void end_run() override {}

  std::vector<double> begins;
};

/// Unit blocks along x; vertex 3 is `height` off the line.
Polygon line(double height) {
  Polygon polygon;
  polygon.start(Vec3::Zero(), 0.0);
  for (int i = 1; i <= 20; ++i) {
    polygon.push(Vec3(i, i == 3 ? height : 0.0, 0.0));
  }
  return polygon;
}

Stretch whole(const Polygon& polygon) {
  return {&polygon, 0, polygon.last() - 1, polygon[0].s, polygon[polygon.last()].s};
}

SpanCubic straight(double begin, double end) {
  return {begin, end, Vec3(begin, 0, 0), Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()};
}

TEST(SpanChecker, AppendsASpanWithinItsLimit) {
  const Polygon polygon = line(0.0);
  SpanChecker spans;
  spans.start(0.01);
  spans.begin_run();
  EXPECT_FALSE(spans.append(straight(0.0, 5.0), whole(polygon), 0));
  EXPECT_EQ(spans.next(), 1U);
}

TEST(SpanChecker, NamesTheBlockOfASpanBeyondItsLimit) {
  const Polygon polygon = line(0.02);
  SpanChecker spans;
  spans.start(0.01);
  spans.begin_run();
  const auto block = spans.append(straight(0.0, 5.0), whole(polygon), 0);
  ASSERT_TRUE(block);
  EXPECT_GE(*block, 2U);
  EXPECT_LE(*block, 3U);
  EXPECT_EQ(spans.next(), 0U);
}

TEST(SpanChecker, TakesTheShortestSpanAsItIs) {
  const Polygon polygon = line(0.02);
  SpanChecker spans;
  spans.start(0.001);
  spans.begin_run();
  EXPECT_FALSE(spans.append(straight(3.0, 3.0 + 0.9 * kShortestSpan), whole(polygon), 2));
}

TEST(SpanChecker, HoldsSpansBackAndReleasesThemInOrder) {
  const Polygon polygon = line(0.0);
  Recorder sink;
  SpanChecker spans;
  spans.start(0.01);
  spans.begin_run();
  for (int i = 0; i < 15; ++i) {
    ASSERT_FALSE(spans.append(straight(i, i + 1.0), whole(polygon), static_cast<std::size_t>(i)));
    if (spans.holds_too_many()) {
      spans.release_oldest(sink);
    }
  }
  EXPECT_EQ(sink.begins, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(spans.last_fixed_knot(), spans.released() + kReach - 1);
  spans.release_all(sink);
  EXPECT_EQ(sink.begins.size(), 15U);
  EXPECT_EQ(sink.begins.back(), 14.0);
}

TEST(SpanChecker, ForgetsNoSpanThatIsReleased) {
  const Polygon polygon = line(0.0);
  Recorder sink;
  SpanChecker spans;
  spans.start(0.01);
  spans.begin_run();
  for (int i = 0; i < 8; ++i) {
    ASSERT_FALSE(spans.append(straight(i, i + 1.0), whole(polygon), static_cast<std::size_t>(i)));
  }
  spans.release_oldest(sink);
  spans.truncate(8);
  EXPECT_EQ(spans.next(), 8 - kReach + 1);
  spans.truncate(0);
  EXPECT_EQ(spans.next(), spans.released());
}

}  // namespace span_checker_test
}  // namespace twin::geometry
