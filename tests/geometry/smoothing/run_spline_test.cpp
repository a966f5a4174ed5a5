#include "geometry/smoothing/run_spline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace twin::geometry {
namespace run_spline_test {

constexpr double kTolerance = 0.01;

/// What comes out of a run.
class Taken : public RunSink {
 public:
  void take_span(const geometry::SpanCubic& span, double bound) override {
    spans.push_back(span);
    deviation = std::max(deviation, bound);
  }
  void take_block(const Vec3& from, const Vec3& to, double begin, double end) override {
    spans.push_back({begin, end, from, (to - from) / (end - begin), Vec3::Zero(), Vec3::Zero()});
  }
  void end_run() override { ++runs; }

  std::vector<geometry::SpanCubic> spans;
  double deviation = 0.0;
  int runs = 0;
};

void fit(const std::vector<Vec3>& points, Taken& taken) {
  RunSpline run(taken);
  run.start(points.front(), 0.0, kTolerance);
  for (std::size_t i = 1; i < points.size(); ++i) {
    run.push(points[i]);
  }
  run.finish();
}

double curvature(const geometry::SpanCubic& span, double s) {
  const double t = s - span.begin;
  const Vec3 first = span.c1 + t * (2.0 * span.c2 + 3.0 * t * span.c3);
  const Vec3 second = span.second(s);
  return (second - second.dot(first) / first.squaredNorm() * first).norm() / first.squaredNorm();
}

std::vector<Vec3> circle(double radius, double chord, int count, double grain = 0.0) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    const double angle = i * chord / radius;
    points.emplace_back(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0);
    if (grain > 0.0) {
      points.back() = grain * (points.back() / grain).array().round().matrix();
    }
  }
  return points;
}

std::vector<Vec3> wave(int count, double step) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    const double x = step * i;
    points.emplace_back(x, 2.0 * std::sin(0.7 * x) + 0.3 * std::sin(2.9 * x), 0.1 * std::cos(x));
  }
  return points;
}

void expect_c2(const Taken& taken) {
  for (std::size_t i = 1; i < taken.spans.size(); ++i) {
    const geometry::SpanCubic& a = taken.spans[i - 1];
    const geometry::SpanCubic& b = taken.spans[i];
    const double t = a.end - a.begin;
    ASSERT_EQ(a.end, b.begin);
    ASSERT_LT((a.position(a.end) - b.c0).norm(), 1e-11);
    ASSERT_LT((a.c1 + t * (2.0 * a.c2 + 3.0 * t * a.c3) - b.c1).norm(), 1e-9);
    ASSERT_LT((a.second(a.end) - 2.0 * b.c2).norm(), 1e-6);
  }
}

TEST(RunSpline, IsTwiceContinuousFromEndToEnd) {
  const auto points = wave(2000, 0.02);
  Taken taken;
  fit(points, taken);
  EXPECT_EQ(taken.runs, 1);
  EXPECT_LT(taken.spans.size(), 300U);
  EXPECT_LE(taken.deviation, kTolerance);
  expect_c2(taken);
  EXPECT_LT((taken.spans.front().c0 - points.front()).norm(), 1e-12);
  EXPECT_LT((taken.spans.back().position(taken.spans.back().end) - points.back()).norm(), 1e-12);
  EXPECT_LT(taken.spans.front().c2.norm(), 1e-9);
  EXPECT_LT(taken.spans.back().second(taken.spans.back().end).norm(), 1e-9);
}

TEST(RunSpline, MakesAStraightLineOfAStraightLine) {
  for (const int count : {2, 3, 10, 2000, 20000}) {
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) {
      points.push_back(100.0 * i / count * Vec3(0.6, 0.0, 0.8));
    }
    Taken taken;
    fit(points, taken);
    EXPECT_LT(taken.deviation, 1e-10);
    for (const geometry::SpanCubic& span : taken.spans) {
      EXPECT_LT(curvature(span, span.begin), 1e-9) << count;
    }
  }
}

TEST(RunSpline, GivesACirclesChordsItsCurvature) {
  for (const double chord : {0.05, 0.26, 0.6}) {
    Taken taken;
    fit(circle(20.0, chord, static_cast<int>(120.0 / chord)), taken);
    EXPECT_EQ(taken.runs, 1);
    for (const geometry::SpanCubic& span : taken.spans) {
      if (span.begin > 20.0 && span.end < 100.0) {
        EXPECT_NEAR(curvature(span, span.begin), 0.05, 0.05 * 0.015) << chord;
      }
    }
  }
}

TEST(RunSpline, MakesNoCurvatureOfRounding) {
  Taken taken;
  fit(circle(400.0, 0.02, 20000, 0.001), taken);
  EXPECT_EQ(taken.runs, 1);
  EXPECT_LT(taken.spans.size(), 80U);
  for (const geometry::SpanCubic& span : taken.spans) {
    EXPECT_LT(curvature(span, span.begin), 0.005);
    if (span.begin > 30.0 && span.end < 370.0) {
      EXPECT_NEAR(curvature(span, span.begin), 1.0 / 400.0, 3e-4);
    }
  }
}

TEST(RunSpline, AChangeFarAheadMovesNothing) {
  const auto points = wave(3000, 0.05);
  auto changed = points;
  for (std::size_t i = 2000; i < changed.size(); ++i) {
    changed[i] += Vec3(0.5, 0.1 * std::sin(0.1 * static_cast<double>(i)), 0.0);
  }
  Taken a;
  Taken b;
  fit(points, a);
  fit(changed, b);
  double length = 0.0;
  for (std::size_t i = 1; i < 2000; ++i) {
    length += (points[i] - points[i - 1]).norm();
  }
  std::size_t same = 0;
  for (; a.spans[same].end < length - 60.0; ++same) {
    ASSERT_EQ(a.spans[same].c0, b.spans[same].c0);
    ASSERT_EQ(a.spans[same].c1, b.spans[same].c1);
    ASSERT_EQ(a.spans[same].c2, b.spans[same].c2);
    ASSERT_EQ(a.spans[same].c3, b.spans[same].c3);
  }
  EXPECT_GT(same, 20U);
}

TEST(RunSpline, BreaksAtAVertexThatNoSplineRounds) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) {
    points.emplace_back(0.5 * i, i > 20 ? 0.5 * (i - 20) : 0.0, 0.0);
  }
  Taken taken;
  fit(points, taken);
  EXPECT_LE(taken.deviation, kTolerance);
  EXPECT_GE(taken.spans.size(), 2U);
}

}  // namespace run_spline_test
}  // namespace twin::geometry
