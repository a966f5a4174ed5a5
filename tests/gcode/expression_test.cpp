#include "gcode/values/expression.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gcode/values/message.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {
namespace expression_test {

Parameters some_parameters(Dialect dialect) {
  Parameters parameters(nullptr, dialect);
  EXPECT_TRUE(parameters.set_later(1, 2.0, 1));
  EXPECT_TRUE(parameters.set_later(2, 1.0, 1));
  EXPECT_TRUE(parameters.set_later("long name", 7.5, 1));
  parameters.commit();
  return parameters;
}

double value_of(std::string_view text, Dialect dialect = Dialect::kLinuxCnc) {
  std::size_t at = 0;
  const auto value = read_value(text, at, some_parameters(dialect));
  EXPECT_TRUE(value) << text << ": " << (value ? "" : value.error().message);
  EXPECT_EQ(at, text.size()) << text;
  return value ? *value : std::nan("");
}

std::string fault_of(std::string_view text) {
  std::size_t at = 0;
  const auto value = read_value(text, at, some_parameters(Dialect::kLinuxCnc));
  EXPECT_FALSE(value) << text;
  return value ? "" : fmt::format("{}: {}", value.error().column, value.error().message);
}

TEST(Expression, StrongerOperatorsComeFirstAndTheLeftOneOfEqualOnes) {
  EXPECT_EQ(value_of("[1+2*3]"), 7.0);
  EXPECT_EQ(value_of("[2*3**2]"), 18.0);
  EXPECT_EQ(value_of("[2**3**2]"), 64.0);
  EXPECT_EQ(value_of("[10-4-3]"), 3.0);
  EXPECT_EQ(value_of("[2.0 / 3 * 1.5 - 5.5 / 11.0]"), 0.5);
  EXPECT_EQ(value_of("[1 + 1 EQ 2 AND 3 GT 2]"), 1.0);
  EXPECT_EQ(value_of("[0 OR 1 XOR 1]"), 0.0);
  EXPECT_EQ(value_of("[7 mod 3 * 2]"), 2.0);
  EXPECT_EQ(value_of("[-7 MOD 3]"), 2.0);
  EXPECT_EQ(value_of("[-2**2]"), 4.0);
  EXPECT_NEAR(value_of("[1 + acos[0] - [#1 ** [4.0/2]]]"), 87.0, 1e-12);
}

TEST(Expression, ComparisonsTakeMicrodifferencesAsNone) {
  EXPECT_EQ(value_of("[1 EQ 1.0000005]"), 1.0);
  EXPECT_EQ(value_of("[1 NE 1.000002]"), 1.0);
  EXPECT_EQ(value_of("[1 GE 1]"), 1.0);
  EXPECT_EQ(value_of("[1 LT 1]"), 0.0);
  EXPECT_EQ(value_of("[1 LE 1]"), 1.0);
}

TEST(Expression, FunctionsInDegrees) {
  EXPECT_NEAR(value_of("SIN[30]"), 0.5, 1e-15);
  EXPECT_NEAR(value_of("cos[60]"), 0.5, 1e-15);
  EXPECT_NEAR(value_of("TAN[45]"), 1.0, 1e-15);
  EXPECT_NEAR(value_of("ASIN[1]"), 90.0, 1e-12);
  EXPECT_NEAR(value_of("ATAN[1]/[-1]"), 135.0, 1e-12);
  EXPECT_NEAR(value_of("ATAN[-1]/[-1]"), -135.0, 1e-12);
  EXPECT_EQ(value_of("SQRT[9]"), 3.0);
  EXPECT_EQ(value_of("ABS[-3]"), 3.0);
  EXPECT_EQ(value_of("EXP[0]"), 1.0);
  EXPECT_EQ(value_of("LN[1]"), 0.0);
  EXPECT_EQ(value_of("FIX[2.8]"), 2.0);
  EXPECT_EQ(value_of("FIX[-2.8]"), -3.0);
  EXPECT_EQ(value_of("FUP[2.8]"), 3.0);
  EXPECT_EQ(value_of("FUP[-2.8]"), -2.0);
  EXPECT_EQ(value_of("ROUND[2.5]"), 3.0);
  EXPECT_EQ(value_of("ROUND[-2.5]"), -3.0);
  EXPECT_EQ(value_of("EXISTS[#<longname>]"), 1.0);
  EXPECT_EQ(value_of("EXISTS[#<other>]"), 0.0);
  EXPECT_EQ(value_of("EXISTS[#5]"), 1.0);
  EXPECT_EQ(value_of("EXISTS[#5603]"), 0.0);
}

TEST(Expression, FanucRoundsByMagnitudeAndCountsTheCircleFromZero) {
  EXPECT_EQ(value_of("FIX[-1.2]", Dialect::kFanuc), -1.0);
  EXPECT_EQ(value_of("FUP[-1.2]", Dialect::kFanuc), -2.0);
  EXPECT_NEAR(value_of("ATAN[-1]/[-1]", Dialect::kFanuc), 225.0, 1e-12);
  EXPECT_EQ(value_of("[12 AND 10]", Dialect::kFanuc), 8.0);
  EXPECT_EQ(value_of("POW[2, 10]", Dialect::kFanuc), 1024.0);
}

TEST(Expression, ParametersByNumberByNameAndByParameter) {
  EXPECT_EQ(value_of("#1"), 2.0);
  EXPECT_EQ(value_of("##2"), 2.0);
  EXPECT_EQ(value_of("#[#2 + 0]"), 1.0 + 1.0);
  EXPECT_EQ(value_of("-#1"), -2.0);
  EXPECT_EQ(value_of("#<Long Name>"), 7.5);
  EXPECT_EQ(value_of("#4711"), 0.0);
}

TEST(Expression, FaultsSayWhereAndWhat) {
  EXPECT_EQ(fault_of("[1+]"), "4: expected a number, #, [ or a function, found ']'");
  EXPECT_EQ(fault_of("[1"), "1: the expression has no end: expected ]");
  EXPECT_EQ(fault_of("[1 2]"), "4: expected an operator or ], found '2]'");
  EXPECT_EQ(fault_of("[1/0]"), "3: 1 is divided by zero");
  EXPECT_EQ(fault_of("[1 MOD 0]"), "4: 1 is divided by zero");
  EXPECT_EQ(fault_of("[-8 ** 0.5]"), "5: the operation on -8 and 0.5 gives no finite number");
  EXPECT_EQ(fault_of("SQRT[-1]"), "1: SQRT[-1] is no finite number");
  EXPECT_EQ(fault_of("#5603"), "1: #5603: expected a parameter from #1 to #5602");
  EXPECT_EQ(fault_of("#0"), "1: #0: expected a parameter from #1 to #5602");
  EXPECT_EQ(fault_of("#1.5"), "1: #1.5: expected a parameter from #1 to #5602");
  EXPECT_EQ(fault_of("FOO[1]"),
            "1: 'FOO' is no function: expected ABS, ACOS, ASIN, ATAN, COS, "
            "EXISTS, EXP, FIX, FUP, LN, ROUND, SIN, SQRT or TAN");
  EXPECT_EQ(fault_of("ATAN[1]"), "8: ATAN: the line ends where / is expected");
  EXPECT_EQ(fault_of("EXISTS[5]"), "8: EXISTS: expected #, found '5]'");
  EXPECT_EQ(fault_of("EXISTS[#a]"), "9: EXISTS: expected <, found 'a]'");
  EXPECT_EQ(fault_of(std::string(60, '[')),
            "51: the value is nested too deep: expected at most 50 levels");
}

TEST(Parameters, WhatALineSetsTakesEffectBehindIt) {
  Parameters parameters(nullptr, Dialect::kLinuxCnc);
  std::size_t at = 0;
  const std::string_view first = "#3=15";
  ASSERT_TRUE(read_assignment(first, at, parameters));
  EXPECT_EQ(*parameters.numbered(3, 1), 0.0);
  parameters.commit();
  EXPECT_EQ(*parameters.numbered(3, 1), 15.0);
  at = 0;
  const std::string_view second = "# 4 = [#3 * 2]";
  ASSERT_TRUE(read_assignment(second, at, parameters));
  parameters.commit();
  EXPECT_EQ(*parameters.numbered(4, 1), 30.0);
}

TEST(Message, ParametersOfDebugAndPrintAreReplaced) {
  const Parameters parameters = some_parameters(Dialect::kLinuxCnc);
  EXPECT_EQ(message_of("MSG, depth #1", parameters), "depth #1");
  EXPECT_EQ(message_of(" m s g,turn", parameters), "turn");
  EXPECT_EQ(message_of("DEBUG, a=#1 b=%d#<long name> c=%.2f#2", parameters),
            "a=2.000000 b=8 c=1.00");
  EXPECT_EQ(message_of("print,#<none> #", parameters), "###### #");
  EXPECT_EQ(message_of("just a comment", parameters), std::nullopt);
  EXPECT_EQ(message_of("MSGS, x", parameters), std::nullopt);
}

}  // namespace expression_test
}  // namespace twin::gcode
