#include "studies/convert/dialect.hpp"

#include <gtest/gtest.h>

namespace twin::studies::convert {
namespace dialect_test {

TEST(Number, FewestDigits) {
  EXPECT_EQ(number(1.25, 6), "1.25");
  EXPECT_EQ(number(-3.0, 6), "-3");
  EXPECT_EQ(number(0.1 + 0.2, 6), "0.3");
  EXPECT_EQ(number(1e-7, 6), "0");
  EXPECT_EQ(number(-1e-7, 6), "0");
  EXPECT_EQ(number(120.0, 0), "120");
  EXPECT_EQ(number(1e9, 4), "1000000000");
  EXPECT_EQ(number(2.0 / 3.0, 4), "0.6667");
}

TEST(Number, RoundedIsWhatIsWritten) {
  EXPECT_EQ(rounded(2.0 / 3.0, 4), 0.6667);
  EXPECT_EQ(rounded(-1e-9, 6), 0.0);
}

}  // namespace dialect_test
}  // namespace twin::studies::convert
