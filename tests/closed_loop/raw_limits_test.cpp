#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "tests/closed_loop/every_program.hpp"
#include "tests/support/loop_fixture.hpp"
#include "tests/support/trace_rows.hpp"
#include "tests/support/way_between.hpp"

// Acceleration and jerk of every program with both planners, from the rows of trace.csv and nothing
// else: a second opinion beside results::LimitAudit, which prints what is claimed.
namespace twin::test {
namespace raw_limits_test {

constexpr double kPeriod = 1e-3;  // [s]
// What set points may be off a common line or circle to count as on it [mm]. The third difference
// of lengths that are 4 nm off is 16 mm/s^3 off.
constexpr double kOnPiece = 4e-9;
constexpr double kJerkDoubt = 1.001;
constexpr double kNormalDoubt = 1.02;  // where the curvature changes within a period

/// Largest values, and of how many places.
struct Peaks {
  double tangential_acceleration = 0.0;  ///< [mm/s^2]
  double normal_acceleration = 0.0;      ///< [mm/s^2]
  double jerk = 0.0;                     ///< [mm/s^3]
  std::size_t on_piece = 0;              ///< windows on one line or circle
  std::size_t all = 0;
};

/// Four successive points give one third difference of the way: on a line the way is the chord, on
/// a circle the arc over it. Windows with a joint in them are on neither, and left out.
///
/// @param around  the four points, with the one before and the one after them
void look_along(std::span<const Vec3, 6> around, Peaks& peaks) {
  ++peaks.all;
  const auto s = lengths_between(around, kOnPiece);
  if (!s) {
    return;
  }
  ++peaks.on_piece;
  const auto& [a, b, c] = *s;
  const double t2 = kPeriod * kPeriod;
  peaks.tangential_acceleration =
      std::max({peaks.tangential_acceleration, std::abs(b - a) / t2, std::abs(c - b) / t2});
  peaks.jerk = std::max(peaks.jerk, std::abs(c - 2.0 * b + a) / (t2 * kPeriod));
}

Peaks peaks_of(const TraceRows& rows) {
  const auto x = rows.column("x_cmd_mm");
  const auto y = rows.column("y_cmd_mm");
  const auto z = rows.column("z_cmd_mm");
  std::vector<Vec3> points(4, Vec3(x.front(), y.front(), z.front()));  // rest before
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.emplace_back(x[i], y[i], z[i]);
  }
  points.insert(points.end(), 4, Vec3(points.back()));  // and after
  Peaks peaks;
  for (std::size_t i = 5; i < points.size(); ++i) {
    look_along(std::span<const Vec3, 6>(&points[i - 5], 6), peaks);
    peaks.normal_acceleration =
        std::max(peaks.normal_acceleration,
                 normal_acceleration(points[i - 2], points[i - 1], points[i], kPeriod));
  }
  return peaks;
}

/// Share of a program that is lines and arcs, at least: so much must have been looked at.
double least_share(const std::string& program) {
  if (program == "circle.nc" || program == "square.nc" || program == "identify.nc") {
    return 0.9;
  }
  return program == "zigzag.nc" ? 0.0 : 0.1;  // its blocks are of a tenth of a millimetre
}

class RawLimits : public LoopTest, public ::testing::WithParamInterface<ProgramCase> {};

TEST_P(RawLimits, AccelerationAndJerkAreKeptOnLinesAndArcs) {
  config::MachineFile file = machine();
  ASSERT_EQ(file.period, kPeriod);
  file.path.planner = GetParam().planner;
  execute(program(GetParam().program), file, nullptr, std::nullopt);
  const Peaks peaks = peaks_of(TraceRows(folder / "out/trace.csv"));
  const Limits& limits = file.limits;
  EXPECT_LE(peaks.tangential_acceleration, limits.acceleration * kJerkDoubt);
  EXPECT_LE(peaks.jerk, limits.jerk * kJerkDoubt);
  EXPECT_LE(peaks.normal_acceleration, limits.acceleration * kNormalDoubt);
  const double share = static_cast<double>(peaks.on_piece) / static_cast<double>(peaks.all);
  EXPECT_GE(share, least_share(GetParam().program));
  // A motion that is slow proves nothing.
  EXPECT_GE(peaks.jerk, 0.9 * limits.jerk);
  RecordProperty("share_on_lines_and_arcs", std::to_string(share));
  RecordProperty("jerk_mm_per_s3", std::to_string(peaks.jerk));
}

INSTANTIATE_TEST_SUITE_P(Programs, RawLimits, ::testing::ValuesIn(every_program()),
                         [](const auto& tested) { return tested.param.name(); });

}  // namespace raw_limits_test
}  // namespace twin::test
