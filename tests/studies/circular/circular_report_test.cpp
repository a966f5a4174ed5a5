#include "studies/circular/circular_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.hpp"
#include "core/units.hpp"

namespace twin::studies::circular {
namespace report_test {

using ::testing::HasSubstr;
using ::testing::Not;

Report example() {
  Report report;
  report.machine = "xy_table";
  report.hal = "mujoco";
  report.radius = 20.0;
  report.feedrate = 50.0;
  report.reached = {50.0, 50.0};
  report.table.deviations.hysteresis = 0.0125;
  report.table.deviations.sense[1].circular = 0.020;
  report.table.deviations.mean_radial = -1e-9;
  report.encoder.deviations.hysteresis = 0.030;
  report.table.spikes[0].quadrant[2] = {units::rad_from_deg(184.5), 0.009,
                                        units::rad_from_deg(2.0)};
  report.table.spikes[0].ripple = 0.004;
  report.predicted = -0.0028;
  return report;
}

TEST(Report, JsonHasUnitsInItsKeysAndTableBeforeEncoder) {
  const Json json = parse_json(to_json(example()));
  EXPECT_EQ(json["table"]["circular_hysteresis_um"], 12.5);
  EXPECT_EQ(json["encoder"]["circular_hysteresis_um"], 30.0);
  EXPECT_EQ(json["table"]["circular_deviation_um"]["cw"], 20.0);
  const Json& spike = json["table"]["reversal_spikes"][2];
  EXPECT_EQ(spike["quadrant_deg"], 180);
  EXPECT_EQ(spike["axis"], "x");
  EXPECT_EQ(spike["ccw"]["height_um"], 9.0);
  EXPECT_EQ(spike["ccw"]["angle_deg"], 184.5);
  EXPECT_EQ(json["predicted_radial_deviation_um"], -2.8);
  EXPECT_LT(to_json(example()).find("\"table\""), to_json(example()).find("\"encoder\""));
}

TEST(Report, JsonHasNullWhereThereIsNoPrediction) {
  Report report = example();
  report.predicted.reset();
  EXPECT_TRUE(parse_json(to_json(report))["predicted_radial_deviation_um"].is_null());
}

TEST(Report, TableSaysWhatWasMeasuredWhere) {
  const std::string text = to_table(example());
  EXPECT_THAT(text, HasSubstr("circular test on xy_table (mujoco), radius 20 mm, 3000 mm/min\n"));
  EXPECT_THAT(text, HasSubstr("as a ballbar sees it"));
  EXPECT_THAT(text,
              HasSubstr("circular hysteresis H                         12.500    30.000  um"));
  EXPECT_THAT(text, HasSubstr("9.00     184.5       2.0 "));
  EXPECT_THAT(text, HasSubstr("D predicted by Eq. 3"));
  EXPECT_THAT(text, Not(HasSubstr("-0.000")));
  EXPECT_THAT(text, Not(HasSubstr("limits let it run")));
}

TEST(Report, TableNamesWhatKeptItFromThePrediction) {
  Report report = example();
  report.predicted.reset();
  report.no_prediction = "Eq. 3 has no Ka";
  report.reached = {22.0, 22.0};
  report.table.spikes[0].ripple = 0.010;
  const std::string text = to_table(report);
  EXPECT_THAT(text, HasSubstr("no prediction of D by Eq. 3: Eq. 3 has no Ka"));
  EXPECT_THAT(text, HasSubstr("limits let it run at 1320 mm/min only"));
  EXPECT_THAT(text, HasSubstr("  2.0*"));
  EXPECT_THAT(text, HasSubstr("* not above the ripple"));
}

}  // namespace report_test
}  // namespace twin::studies::circular
