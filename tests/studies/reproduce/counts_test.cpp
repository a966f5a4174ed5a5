#include "studies/reproduce/counts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "answers.hpp"

namespace twin::studies::reproduce {
namespace counts_test {

using ::testing::ElementsAre;

TEST(Counts, WithinIsTheDistanceOfTheRatioFromOne) {
  EXPECT_TRUE(is_within(11.0, 10.0, 0.10));
  EXPECT_TRUE(is_within(9.0, 10.0, 0.10));
  EXPECT_FALSE(is_within(11.001, 10.0, 0.10));
  EXPECT_FALSE(is_within(8.999, 10.0, 0.10));
  EXPECT_TRUE(is_within(0.039, 0.030, 0.30));
}

TEST(Counts, AllFiguresOfTables4And5AreCounted) {
  EXPECT_THAT(count(test::scaled(1.0, 1.0).as_published(), Of::kSingle).within,
              ElementsAre(56, 56, 56));
  EXPECT_THAT(count(test::scaled(1.15, 1.0).as_published(), Of::kSingle).within,
              ElementsAre(0, 56, 56));
  EXPECT_THAT(count(test::scaled(0.75, 1.0).as_published(), Of::kSingle).within,
              ElementsAre(0, 0, 56));
  EXPECT_THAT(count(test::scaled(1.31, 1.0).as_published(), Of::kSingle).within,
              ElementsAre(0, 0, 0));
}

TEST(Counts, MeanIsCountedByItself) {
  const Reproduction reproduction = test::scaled(1.5, 0.95);
  EXPECT_THAT(count(reproduction.as_published(), Of::kMean).within, ElementsAre(56, 56, 56));
  EXPECT_NEAR(count(reproduction.as_published(), Of::kMean).worst_time, -0.05, 1e-12);
  EXPECT_NEAR(count(reproduction.as_published(), Of::kSingle).worst_time, 0.5, 1e-12);
}

TEST(Counts, ARowNamesTheFiguresThatAreMoreThan30PercentOff) {
  Reproduction reproduction = test::scaled(1.0, 1.0);
  Answer& row = reproduction.variants[0].answers.back();
  EXPECT_EQ(missed(row, Of::kSingle), "");
  row.single[2] *= 0.69;
  row.single[6] *= 1.31;
  EXPECT_EQ(missed(row, Of::kSingle), "X max, time");
  EXPECT_EQ(missed(row, Of::kMean), "");
  EXPECT_THAT(count(reproduction.as_published(), Of::kSingle).within, ElementsAre(54, 54, 54));
}

}  // namespace counts_test
}  // namespace twin::studies::reproduce
