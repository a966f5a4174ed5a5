#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "butterfly.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/deviation.hpp"
#include "geometry/nurbs/fit.hpp"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: g++ would see free() meet memory of operator new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace twin::geometry {
namespace {

template <class Call>
long allocations_of(Call call) {
  const long before = allocations;
  call();
  return allocations - before;
}

TEST(Allocation, IsCountedHere) {
  EXPECT_GE(allocations_of([] { delete new std::vector<double>(100); }), 1);
}

TEST(Allocation, EvaluationNeedsNone) {
  const Curve curve = test::butterfly();
  ArcLength arc;
  arc.build(curve);
  double sum = 0.0;
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 1000; ++i) {
                const double u = i * 1e-3;
                sum +=
                    curve.position(u).x() + curvature(curve.derivatives(u, curve.find_span(u, 5)));
                sum += arc.u_at(curve, arc.s_at(curve, u) + 0.01, u);
              }
            }),
            0);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(Allocation, FittingAgainNeedsNone) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) {
    points.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i), 0.0);
  }
  Fitter fitter;
  Curve curve;
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  const auto all = [&] {
    const EndCondition end = joint_condition(fitter, std::span(points).last(9), 8);
    fitter.fit(points, end, end, curve);
    deviation_bound(curve, points, fitter.parameters());
    arc.build(curve, &samples);
  };
  EXPECT_GT(allocations_of(all), 0);
  EXPECT_EQ(allocations_of(all), 0);
}

}  // namespace
}  // namespace twin::geometry
