#include "core/error.hpp"

#include <gtest/gtest.h>

namespace twin {
namespace error_test {

TEST(Error, TextLeavesOutThePlaceThatIsNotKnown) {
  const auto text = [](std::string file, int line, int column) {
    return to_string(Error{ErrorCode::kProgram, "no F word", std::move(file), line, column});
  };
  EXPECT_EQ(text("a.nc", 3, 7), "a.nc:3:7: no F word");
  EXPECT_EQ(text("a.nc", 3, 0), "a.nc:3: no F word");
  EXPECT_EQ(text("a.nc", 0, 7), "a.nc: no F word");
  EXPECT_EQ(text("", 3, 7), "line 3:7: no F word");
  EXPECT_EQ(text("", 0, 0), "no F word");
}

TEST(Error, InterruptionExitsAsAShellDoes) {
  EXPECT_EQ(exit_status(Error{ErrorCode::kInterrupted, "", "", 0, 0}), 130);
}

TEST(Error, OnlyBadUsageExitsWithTwo) {
  EXPECT_EQ(exit_status(Error{ErrorCode::kUsage, "", "", 0, 0}), 2);
  for (const ErrorCode code :
       {ErrorCode::kProgram, ErrorCode::kFile, ErrorCode::kModel, ErrorCode::kMachine}) {
    EXPECT_EQ(exit_status(Error{code, "", "", 0, 0}), 1);
  }
}

TEST(Error, FailCarriesCodeAndMessageWithoutAPlace) {
  const Expected<int> result = fail(ErrorCode::kMachine, "alarm of the x drive");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kMachine);
  EXPECT_EQ(to_string(result.error()), "alarm of the x drive");
}

}  // namespace error_test
}  // namespace twin
