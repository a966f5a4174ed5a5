#include "studies/identify/table_side.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulated_recording.hpp"
#include "studies/identify/sine_steps.hpp"

namespace twin::studies::identify {
namespace table_side_test {

constexpr double kPeriod = 1e-3;
constexpr double kForgetting = 0.5;

AxisRecord record_of_strokes() {
  AxisRecord record;
  const std::vector<double> positions = strokes(4.0, kPeriod);
  record.command = differentiate(positions, kPeriod);
  record.measured = positions;
  return record;
}

/// RMS of a residual of the table, without the share that the nut's unknown place at the begin has.
template <class Apart>
double rms_of(const AxisRecord& record, bool takes_shares_off, Apart apart) {
  const TableSide side(record, kPeriod, kForgetting, takes_shares_off);
  Eigen::VectorXd values(static_cast<Eigen::Index>(record.measured.size()));
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    values[k] = apart(record.command[static_cast<std::size_t>(k)]);
  }
  side.take(values, record);
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

TEST(TableSide, AnInexactLeadAndALateScaleLeaveNothing) {
  const AxisRecord record = record_of_strokes();
  const auto apart = [](const motion::Reference& r) {
    return 3.0 + 2e-4 * r.position - 0.3e-3 * r.velocity;
  };
  EXPECT_LT(rms_of(record, true, apart), 2e-4);
  EXPECT_GT(rms_of(record, false, apart), 1e-3);
}

TEST(TableSide, LostMotionAndStretchStay) {
  const AxisRecord record = record_of_strokes();
  const auto lost = [](const motion::Reference& r) { return r.velocity > 0.0 ? -5e-3 : 5e-3; };
  EXPECT_GT(rms_of(record, true, lost), 1e-3);
  const auto stretch = [](const motion::Reference& r) { return -5e-6 * r.acceleration; };
  EXPECT_GT(rms_of(record, true, stretch), 0.5 * rms_of(record, false, stretch));
}

TEST(TableSide, WhereTheNutStoodAtFirstDoesNotCount) {
  const AxisRecord record = record_of_strokes();
  const auto at_first = [&](const motion::Reference& r) {
    return std::abs(r.position - record.measured.front()) < 0.4 && r.acceleration > 0.0 &&
                   &r < &record.command[100]
               ? 10e-3
               : 0.0;
  };
  EXPECT_EQ(rms_of(record, true, at_first), 0.0);
}

TEST(SineSteps, AreTheSineForAMillionSteps) {
  const double step = 2.0 * std::numbers::pi * 49.97 * 0.8e-4;
  SineSteps sine(20e-3, step, 0.3);
  double largest = 0.0;
  for (long k = 0; k < 1000000; ++k) {
    const double exact = 20e-3 * std::sin(step * static_cast<double>(k) + 0.3);
    largest = std::max(largest, std::abs(sine.next() - exact));
  }
  EXPECT_LT(largest, 20e-3 * 1e-11) << "the angle of the exact one is rounded, too";
}

}  // namespace table_side_test
}  // namespace twin::studies::identify
