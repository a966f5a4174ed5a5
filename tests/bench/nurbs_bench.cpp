#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/deviation.hpp"
#include "geometry/nurbs/fit.hpp"

/// Costs of what planning does to one curve of 20 blocks, and of the interpolator's evaluations.
namespace twin::geometry {
namespace {

constexpr int kBlocks = 20;
constexpr int kMargin = 4;  // points on either side of a joint that its condition looks at

/// A smooth run of points of uneven spacing around 0.3 mm, with 4 decimals as CAM writes them [mm].
std::vector<Vec3> run_points(int count) {
  std::vector<Vec3> points;
  double l = 0.0;
  for (int i = 0; i < count; ++i) {
    l += 0.3 + 0.1 * std::sin(1.7 * i);
    const auto rounded = [](double x) { return std::round(x * 1e4) * 1e-4; };
    points.emplace_back(rounded(10.0 * std::cos(0.1 * l)), rounded(6.0 * std::sin(0.13 * l)), 0.0);
  }
  return points;
}

struct Fitted {
  std::vector<Vec3> points = run_points(kBlocks + 1 + 2 * kMargin);
  std::span<const Vec3> run = std::span(points).subspan(kMargin, kBlocks + 1);
  Fitter fitter;
  EndCondition begin = joint_condition(fitter, std::span(points).first(2 * kMargin + 1), kMargin);
  EndCondition end = joint_condition(fitter, std::span(points).last(2 * kMargin + 1), kMargin);
  Curve curve;
  ArcLength arc;
  std::vector<CurvatureSample> samples;

  Fitted() {
    fitter.fit(run, begin, end, curve);
    arc.build(curve, &samples);
  }
};

void joint(benchmark::State& state) {
  Fitted f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        joint_condition(f.fitter, std::span(f.points).last(2 * kMargin + 1), kMargin));
  }
}
BENCHMARK(joint);

void fit(benchmark::State& state) {
  Fitted f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(f.fitter.fit(f.run, f.begin, f.end, f.curve));
  }
}
BENCHMARK(fit);

void deviation(benchmark::State& state) {
  const Fitted f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(deviation_bound(f.curve, f.run, f.fitter.parameters()));
  }
}
BENCHMARK(deviation);

void arc_length(benchmark::State& state) {
  Fitted f;
  for (auto _ : state) {
    f.arc.build(f.curve);
    benchmark::DoNotOptimize(f.arc.length());
  }
}
BENCHMARK(arc_length);

void arc_length_and_curvature(benchmark::State& state) {
  Fitted f;
  for (auto _ : state) {
    f.arc.build(f.curve, &f.samples);
    benchmark::DoNotOptimize(f.samples.data());
  }
  state.counters["samples"] = static_cast<double>(f.samples.size());
}
BENCHMARK(arc_length_and_curvature);

void whole_curve(benchmark::State& state) {
  Fitted f;
  for (auto _ : state) {
    const EndCondition end =
        joint_condition(f.fitter, std::span(f.points).last(2 * kMargin + 1), kMargin);
    Curve curve;  // as in planning, where the curve is handed on: its arrays are new every time
    f.fitter.fit(f.run, f.begin, end, curve);
    benchmark::DoNotOptimize(deviation_bound(curve, f.run, f.fitter.parameters()));
    ArcLength arc;
    arc.build(curve, &f.samples);
    benchmark::DoNotOptimize(arc.length());
  }
  state.counters["blocks/s"] = benchmark::Counter(static_cast<double>(state.iterations()) * kBlocks,
                                                  benchmark::Counter::kIsRate);
}
BENCHMARK(whole_curve);

void evaluate(benchmark::State& state, const Curve& curve) {
  const double step = (curve.u_max() - curve.u_min()) / 997.0;
  double u = curve.u_min();
  int span = -1;
  for (auto _ : state) {
    span = curve.find_span(u, span);
    benchmark::DoNotOptimize(curve.derivatives(u, span));
    u = u + step > curve.u_max() ? curve.u_min() : u + step;
  }
}
void derivatives_of_cubic(benchmark::State& state) { evaluate(state, Fitted().curve); }
BENCHMARK(derivatives_of_cubic);
void derivatives_of_rational_cubic(benchmark::State& state) {
  evaluate(state, *full_circle(Vec3::Zero(), 10.0, 3));
}
BENCHMARK(derivatives_of_rational_cubic);

/// One period of an interpolator: the parameter for the next arc length, guessed with an error of
/// about 10 nm.
void parameter_at_arc_length(benchmark::State& state) {
  const Fitted f;
  const double step = f.arc.length() / 997.0;
  double s = 0.0;
  double u = 0.0;
  for (auto _ : state) {
    s += step;
    if (s > f.arc.length()) {
      s = step;
      u = 0.0;
    }
    u = f.arc.u_at(f.curve, s, u + step + 1e-5);
    benchmark::DoNotOptimize(u);
  }
}
BENCHMARK(parameter_at_arc_length);

}  // namespace
}  // namespace twin::geometry
