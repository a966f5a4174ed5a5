#include "studies/identify/identification_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "core/json.hpp"

namespace twin::studies::identify {
namespace identification_report_test {

using ::testing::HasSubstr;

Identification example() {
  Identification result;
  AxisFit fit;
  fit.parameters = {{.key = "table.x.moving_mass_kg",
                     .name = "moving mass",
                     .start = 12.0,
                     .value = 12.0,
                     .sigma = std::numeric_limits<double>::infinity(),
                     .relative = 1.0,
                     .verdict = Verdict::kUnidentified,
                     .why = "shows only together with Coulomb friction, bristle stiffness, bristle "
                            "damping and 1 more"},
                    {.key = "table.x.bristle_damping_N_s_per_m",
                     .name = "velocity loop integral time",
                     .start = 1.0,
                     .value = 499.999256,
                     .sigma = 0.00091,
                     .relative = 1e-6,
                     .verdict = Verdict::kIdentified,
                     .why = {}}};
  fit.residual_rms = 0.00196;
  result.axis[hal::kX] = fit;
  result.predictions = {{.trace = "folder/trace.csv",
                         .axis = hal::kX,
                         .measured = {.max = 0.022357, .rms = 0.005},
                         .simulated = {.max = 0.022357, .rms = 0.0049}}};
  return result;
}

TEST(IdentificationReport, TableFitsATerminalAndSaysWhyAValueIsNotIdentified) {
  const std::string table = to_table(example());
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 80U) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
  EXPECT_THAT(table, HasSubstr("499.99926"));
  EXPECT_THAT(table, HasSubstr("0.00091"));
  EXPECT_THAT(table, HasSubstr("moving mass: shows only together with Coulomb friction"));
  EXPECT_THAT(table, HasSubstr("-2.0 %"));
  EXPECT_THAT(table, HasSubstr("Y axis: did not move"));
}

TEST(IdentificationReport, JsonHasNullForADeviationThatIsNotFinite) {
  const auto json = parse_json(to_json(example(), "machine.toml"));
  const auto& parameters = json["axis"]["x"]["parameters"];
  EXPECT_TRUE(parameters[0]["sigma"].is_null());
  EXPECT_EQ(parameters[0]["identified"], false);
  EXPECT_EQ(parameters[1]["value"], 499.999256);
  EXPECT_EQ(json["predictions"][0]["simulated_tracking_error_um"]["rms"], 4.9);
  EXPECT_TRUE(json["axis"]["y"].is_null());
}

// A value that the data do not show, but that the fit is worse without, was said to be the start.
TEST(IdentificationReport, WhatIsKeptAsFittedIsNotSaidToHaveItsStartingValue) {
  Identification result = example();
  FittedParameter& mass = result.axis[hal::kX]->parameters.front();
  EXPECT_THAT(to_table(result), HasSubstr("keep their starting values:\n  moving mass"));
  mass.value = 17.0;
  EXPECT_THAT(to_table(result), HasSubstr("would be worse:\n  moving mass"));
  EXPECT_THAT(to_machine_file(result), HasSubstr("not shown, kept as fitted: shows only"));
}

}  // namespace identification_report_test
}  // namespace twin::studies::identify
