#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "butterfly.hpp"
#include "geometry/nurbs/fit.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace joint_test {

constexpr std::size_t kBlocks = 20;
constexpr std::size_t kMargin = 4;

/// Fits a run in pieces of 20 blocks with common conditions at the joints, as the path builder
/// does.
std::vector<Curve> fit_in_pieces(const std::vector<Vec3>& points) {
  Fitter fitter;
  std::vector<Curve> curves;
  EndCondition begin;
  for (std::size_t first = 0; first + 1 < points.size();) {
    const std::size_t last = std::min(first + kBlocks, points.size() - 1);
    EndCondition end;
    if (last + 1 < points.size()) {
      const std::size_t from = last - std::min(last, kMargin);
      const std::size_t to = std::min(last + kMargin, points.size() - 1);
      end = joint_condition(fitter, std::span(points).subspan(from, to - from + 1), last - from);
      EXPECT_TRUE(end.clamped);
    }
    Curve curve;
    EXPECT_EQ(fitter.fit(std::span(points).subspan(first, last - first + 1), begin, end, curve),
              FitResult::kFitted);
    curves.push_back(std::move(curve));
    begin = end;
    first = last;
  }
  return curves;
}

double rounded(double x) { return std::round(x * 1e4) * 1e-4; }

/// Points on a circle of 1 mm radius with chords of 0.1 mm.
std::vector<Vec3> circle_points(int count, double decimals(double)) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * std::asin(0.05) * i;
    points.emplace_back(decimals(10 + std::cos(a)), decimals(20 + std::sin(a)), 0.0);
  }
  return points;
}

/// Largest |kappa - expected| of curves but for the first and last `margin` mm of the run.
double worst_curvature_error(const std::vector<Curve>& curves, double expected, double margin) {
  double total = 0.0;
  for (const Curve& c : curves) {
    total += c.u_max();
  }
  double before = 0.0;
  double worst = 0.0;
  for (const Curve& c : curves) {
    for (int i = 0; i <= 1000; ++i) {
      const double u = c.u_max() * i / 1000.0;
      if (before + u > margin && before + u < total - margin) {
        worst = std::max(worst, std::abs(curvature(c.derivatives(u)) - expected));
      }
    }
    before += c.u_max();
  }
  return worst;
}

void expect_smooth_joints(const std::vector<Curve>& curves, double tolerance) {
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const Derivatives a = curves[i - 1].derivatives(curves[i - 1].u_max());
    const Derivatives b = curves[i].derivatives(0.0);
    EXPECT_LT((a.position - b.position).norm(), 1e-13);
    EXPECT_LT((a.first - b.first).norm(), tolerance);
    EXPECT_NEAR(curvature(a), curvature(b), tolerance * std::max(1.0, curvature(a)));
  }
}

TEST(Joint, HasContinuousTangentAndCurvature) {
  const auto same = [](double x) { return x; };
  expect_smooth_joints(fit_in_pieces(circle_points(110, same)), 1e-9);
  expect_smooth_joints(fit_in_pieces(circle_points(111, rounded)), 1e-9);
}

TEST(Joint, DoesNotShowInTheCurvatureOfACircle) {
  const auto same = [](double x) { return x; };
  EXPECT_LT(worst_curvature_error(fit_in_pieces(circle_points(110, same)), 1.0, 0.5), 0.003);
}

TEST(Joint, AddsLittleToWhatRoundedCoordinatesDoAnyway) {
  const auto points = circle_points(201, rounded);
  Fitter fitter;
  std::vector<Curve> one(1);
  ASSERT_EQ(fitter.fit(points, {}, {}, one[0]), FitResult::kFitted);
  const double alone = worst_curvature_error(one, 1.0, 0.5);
  const double joined = worst_curvature_error(fit_in_pieces(points), 1.0, 0.5);
  EXPECT_LT(joined, 1.02 * alone);
  EXPECT_LT(joined, 0.07);
}

/// Points on the butterfly at chords of sqrt(8 e / kappa), between 0.02 and 0.5 mm; e = 0.2 um.
struct ButterflyRun {
  Curve curve = test::butterfly();
  std::vector<double> u;
  std::vector<Vec3> points;
  std::vector<double> l = {0.0};  // chord lengths [mm]

  explicit ButterflyRun(double decimals(double)) {
    for (double at = 0.0; at < 1.0;) {
      const Derivatives d = curve.derivatives(at);
      u.push_back(at);
      points.emplace_back(decimals(d.position.x()), decimals(d.position.y()), 0.0);
      const double chord = std::sqrt(8 * 0.2e-3 / std::max(curvature(d), 1e-9));
      at += std::clamp(chord, 0.02, 0.5) / d.first.norm();
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
      l.push_back(l.back() + (points[i] - points[i - 1]).norm());
    }
  }

  /// Whether the chords around block i turn by less than 0.15 rad each, so that the points tell the
  /// curvature.
  bool is_resolved(std::size_t i) const {
    for (std::size_t k = i - 3; k <= i + 3; ++k) {
      if (curvature(curve.derivatives(u[k])) * (l[k + 1] - l[k]) > 0.15) {
        return false;
      }
    }
    return true;
  }

  /// Largest error of kappa(i, part of block i) against expected(i, part), relative to kappa or 0.5
  /// 1/mm.
  double worst(const std::function<double(std::size_t, double)>& kappa,
               const std::function<double(std::size_t, double)>& expected) const {
    double greatest = 0.0;
    for (std::size_t i = 5; i + 6 < points.size(); ++i) {
      for (double part = 0.0; part < 1.0 && is_resolved(i); part += 0.1) {
        const double k = expected(i, part);
        greatest = std::max(greatest, std::abs(kappa(i, part) - k) / std::max(k, 0.5));
      }
    }
    return greatest;
  }
};

double curvature_in_pieces(const ButterflyRun& run, const std::vector<Curve>& curves, std::size_t i,
                           double part) {
  const double u = run.l[i] - run.l[i / kBlocks * kBlocks] + part * (run.l[i + 1] - run.l[i]);
  return curvature(curves[i / kBlocks].derivatives(u));
}

TEST(Joint, PiecesFollowTheCurvatureOfTheButterfly) {
  const ButterflyRun run([](double x) { return x; });
  const auto curves = fit_in_pieces(run.points);
  expect_smooth_joints(curves, 1e-9);
  EXPECT_LT(run.worst([&](auto i, auto part) { return curvature_in_pieces(run, curves, i, part); },
                      [&](auto i, auto part) {
                        const double u = run.u[i] + part * (run.u[i + 1] - run.u[i]);
                        return curvature(run.curve.derivatives(u));
                      }),
            0.05);
}

TEST(Joint, PiecesAreAsSmoothAsOneCurveThroughRoundedPoints) {
  const ButterflyRun run(rounded);
  const auto curves = fit_in_pieces(run.points);
  Fitter fitter;
  Curve one;
  ASSERT_EQ(fitter.fit(run.points, {}, {}, one), FitResult::kFitted);
  EXPECT_LT(run.worst([&](auto i, auto part) { return curvature_in_pieces(run, curves, i, part); },
                      [&](auto i, auto part) {
                        const double u = run.l[i] + part * (run.l[i + 1] - run.l[i]);
                        return curvature(one.derivatives(u));
                      }),
            0.03);
}

TEST(Joint, OfFewPointsIsTheParabolaOrTheLine) {
  Fitter fitter;
  const std::vector<Vec3> line = {{0, 0, 0}, {3, 4, 0}};
  const EndCondition straight = joint_condition(fitter, line, 1);
  EXPECT_TRUE(straight.clamped);
  EXPECT_EQ(straight.first, Vec3(0.6, 0.8, 0));
  EXPECT_EQ(straight.second, Vec3::Zero());
  // Chords 1 and 2: C(l) through (0,0), (1,0), (1,2) at l = 0, 1, 3 is ((4 l - l^2) / 3, (l^2 - l)
  // / 3).
  const std::vector<Vec3> bend = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  const double l[] = {0, 1, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    const EndCondition at = joint_condition(fitter, bend, i);
    EXPECT_TRUE(at.clamped);
    EXPECT_LT((at.first - Vec3(4 - 2 * l[i], 2 * l[i] - 1, 0) / 3).norm(), 1e-15);
    EXPECT_LT((at.second - Vec3(-2, 2, 0) / 3).norm(), 1e-15);
  }
}

TEST(Joint, WithoutACurveIsNotClamped) {
  Fitter fitter;
  const Vec3 p(1, 2, 3);
  EXPECT_FALSE(joint_condition(fitter, {}, 0).clamped);
  EXPECT_FALSE(joint_condition(fitter, std::vector<Vec3>{p}, 0).clamped);
  EXPECT_FALSE(joint_condition(fitter, std::vector<Vec3>{p, p}, 0).clamped);
  EXPECT_FALSE(joint_condition(fitter, std::vector<Vec3>{p, p, 2 * p}, 1).clamped);
  EXPECT_FALSE(joint_condition(fitter, std::vector<Vec3>(9, p), 4).clamped);
  EXPECT_FALSE(joint_condition(fitter, std::vector<Vec3>{p, 2 * p}, 2).clamped);
}

}  // namespace joint_test
}  // namespace twin::geometry
