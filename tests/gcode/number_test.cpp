#include "gcode/number.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

namespace twin::gcode {
namespace number_test {

void expect_number(const std::string& text, double value, std::size_t length) {
  const Number number = parse_number(text);
  EXPECT_EQ(number.status, NumberStatus::kOk) << text;
  EXPECT_EQ(number.value, value) << text;
  EXPECT_EQ(number.length, length) << text;
}

TEST(Number, SignPointAndDigitsInEveryArrangement) {
  expect_number("12", 12.0, 2);
  expect_number("-12.5", -12.5, 5);
  expect_number("+.5", 0.5, 3);
  expect_number("7.", 7.0, 2);
  expect_number("0007", 7.0, 4);
}

TEST(Number, EndsWhereTheDigitsEnd) {
  expect_number("12Y3", 12.0, 2);
  expect_number("1.2.3", 1.2, 3);
  expect_number("1-2", 1.0, 1);
  expect_number("1e3", 1.0, 1);
}

TEST(Number, WhatIsNoNumberIsMissing) {
  for (const char* text : {"", "-", "+", ".", "-.", "--1", "nan", "inf", "-inf", "x", " 1"}) {
    EXPECT_EQ(parse_number(text).status, NumberStatus::kMissing) << text;
  }
}

TEST(Number, TooLargeIsToldFromMissing) {
  EXPECT_EQ(parse_number("1000000000").status, NumberStatus::kOk);
  EXPECT_EQ(parse_number("1000000000.1").status, NumberStatus::kTooLarge);
  EXPECT_EQ(parse_number("-99999999999").status, NumberStatus::kTooLarge);
  EXPECT_EQ(parse_number(std::string(500, '9')).status, NumberStatus::kTooLarge);
}

TEST(Number, IsTheNearestDoubleOfTheCLibrary) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::string text = fmt::format("{}{}.{}", random() % 2 == 0 ? "-" : "",
                                         random() % 1000000000, random() % 1000000000000000ULL);
    const Number number = parse_number(text);
    ASSERT_EQ(number.value, std::strtod(text.c_str(), nullptr)) << text;
    ASSERT_EQ(number.length, text.size());
  }
}

}  // namespace number_test
}  // namespace twin::gcode
