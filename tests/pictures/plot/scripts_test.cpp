#include "pictures/plot/scripts.hpp"

#include <gmock/gmock.h>

namespace twin::pictures {
namespace scripts_test {

TEST(Magnification, IsOneTwoOrFiveTimesAPowerOfTenAndFitsThePicture) {
  EXPECT_EQ(magnification(60.0, 20.0), 100.0);  // 150 wanted
  EXPECT_EQ(magnification(60.0, 12.0), 200.0);  // 250 wanted
  EXPECT_EQ(magnification(60.0, 5.9), 500.0);   // 508 wanted
  EXPECT_EQ(magnification(60.0, 3.1), 500.0);   // 968 wanted
  EXPECT_EQ(magnification(60.0, 2.9), 1000.0);  // 1034 wanted
}

TEST(Magnification, IsOneWhereThereIsNothingToMagnify) {
  EXPECT_EQ(magnification(60.0, 0.0), 1.0);
  EXPECT_EQ(magnification(0.0, 10.0), 1.0);
  EXPECT_EQ(magnification(10.0, 1e6), 1.0);
}

TEST(FigureScripts, APlanHasNoFiguresOfTheMachine) {
  std::vector<std::string> names;
  for (const Script& script : figure_scripts({}, {}, true)) {
    names.push_back(script.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("contour", "feedrate", "acceleration_jerk"));
}

TEST(FigureScripts, ATitleCannotEndItsString) {
  for (const Script& script : figure_scripts({"it's\n!reboot", {}}, {}, false)) {
    EXPECT_THAT(script.text, testing::HasSubstr("'it''s !reboot'"));
  }
}

}  // namespace scripts_test
}  // namespace twin::pictures
