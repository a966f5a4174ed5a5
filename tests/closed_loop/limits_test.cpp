#include <cmath>
#include <ostream>

#include "config/rules.hpp"
#include "results/metrics/limit_audit.hpp"
#include "tests/support/loop_fixture.hpp"
#include "tests/support/trace_rows.hpp"

// Set points of every program of nc_programs against the machine's limits, from differences alone.
namespace twin {
namespace limits_test {

// What differences may be off: across a corner between two set points nobody can tell how long the
// way was. With more corners or shorter periods it is more.
constexpr double kDoubt = 1.02;
constexpr double kMoreDoubt = 1.07;

struct Case {
  const char* program;
  CurveKind curves;
  double period;  // [s]
  double doubt = kDoubt;
  AccelerationProfile profile = AccelerationProfile::kTrapezoidal;
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.program << ", " << kCurveNames[static_cast<std::size_t>(tested.curves)] << ", "
       << 1e3 * tested.period << " ms, profile " << static_cast<int>(tested.profile);
}

class ProgramLimits : public test::LoopTest, public ::testing::WithParamInterface<Case> {};

TEST_P(ProgramLimits, FeedrateAccelerationAndJerkAreKept) {
  config::MachineFile file = machine();
  file.period = GetParam().period;
  file.path.curves = GetParam().curves;
  file.planning.acceleration_profile = GetParam().profile;
  ASSERT_TRUE(config::resolve_planner(file));
  const results::Summary summary =
      execute(program(GetParam().program), file, nullptr, std::nullopt);
  const Limits& limits = file.limits;
  const bool has_rapids = std::string(GetParam().program) == "mixed.nc";
  EXPECT_LE(summary.audit.feedrate, (has_rapids ? limits.rapid_feedrate : 50.0) * 1.0001);
  EXPECT_LE(summary.audit.tangential_acceleration, limits.acceleration * kDoubt);
  EXPECT_LE(summary.audit.normal_acceleration, limits.acceleration * kDoubt);
  EXPECT_LE(summary.audit.tangential_jerk, limits.jerk * GetParam().doubt);
  // Limits that bind are reached: the feedrate is not kept by being slow.
  EXPECT_GE(summary.audit.feedrate, 49.9);
  EXPECT_GE(summary.audit.tangential_jerk, 0.9 * limits.jerk);
}

// The largest second difference of points bounds what the drives see, whatever is called tangential
// or normal: a corner passed without a stop included.
TEST_P(ProgramLimits, VelocityChangesByAMaxTInAPeriodAtMostEachWay) {
  config::MachineFile file = machine();
  file.period = GetParam().period;
  file.path.curves = GetParam().curves;
  file.planning.acceleration_profile = GetParam().profile;
  ASSERT_TRUE(config::resolve_planner(file));
  execute(program(GetParam().program), file, nullptr, std::nullopt);
  const test::TraceRows rows(folder / "out/trace.csv");
  const auto x = rows.column("x_cmd_mm");
  const auto y = rows.column("y_cmd_mm");
  const auto z = rows.column("z_cmd_mm");
  double largest = 0.0;  // [mm/s^2]
  for (std::size_t i = 2; i < x.size(); ++i) {
    const double change =
        std::hypot(x[i] - 2.0 * x[i - 1] + x[i - 2], y[i] - 2.0 * y[i - 1] + y[i - 2],
                   z[i] - 2.0 * z[i - 1] + z[i - 2]);
    largest = std::max(largest, change / (file.period * file.period));
  }
  EXPECT_LE(largest, std::sqrt(2.0) * file.limits.acceleration * kDoubt);
}

INSTANTIATE_TEST_SUITE_P(
    Programs, ProgramLimits,
    ::testing::Values(
        Case{"oxalis.nc", CurveKind::kNurbs, 1e-3}, Case{"dolphin.nc", CurveKind::kNurbs, 1e-3},
        Case{"butterfly.nc", CurveKind::kNurbs, 1e-3}, Case{"circle.nc", CurveKind::kNurbs, 1e-3},
        Case{"square.nc", CurveKind::kNurbs, 1e-3}, Case{"mixed.nc", CurveKind::kNurbs, 1e-3},
        Case{"dolphin.nc", CurveKind::kNone, 1e-3, kMoreDoubt},
        Case{"mixed.nc", CurveKind::kNurbs, 4e-3},
        Case{"dolphin.nc", CurveKind::kNurbs, 1e-3, kDoubt, AccelerationProfile::kFir},
        Case{"mixed.nc", CurveKind::kNurbs, 1e-3, kDoubt, AccelerationProfile::kFir},
        Case{"square.nc", CurveKind::kNurbs, 0.125e-3, kMoreDoubt}));

}  // namespace limits_test
}  // namespace twin
