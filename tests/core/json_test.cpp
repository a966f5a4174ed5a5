#include "core/json.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace twin {
namespace json_test {

TEST(Rounded, KeepsNineSignificantDigits) {
  EXPECT_EQ(rounded(0.1 + 0.2), 0.3);
  EXPECT_EQ(rounded(455.123456789), 455.123457);
  EXPECT_EQ(rounded(-2e-9), -2e-9);
}

TEST(JsonText, EndsWithALineAndHasNullForWhatIsNoNumber) {
  const Json json{{"b", rounded(std::numeric_limits<double>::quiet_NaN())},
                  {"a", rounded_or_null(std::nullopt)},
                  {"c", rounded_or_null(0.5)}};
  EXPECT_EQ(to_text(json), "{\n  \"b\": null,\n  \"a\": null,\n  \"c\": 0.5\n}\n");
}

TEST(JsonText, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_TRUE(Json::accept(to_text(Json{{"program", "caf\xe9.nc"}})));
}

}  // namespace json_test
}  // namespace twin
