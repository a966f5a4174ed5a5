#include "pictures/figure/workshop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures {
namespace workshop_test {

using test::content;
using test::put;
using ::testing::HasSubstr;

TEST(Workshop, LeavesNothingThatWasNotDelivered) {
  const test::TempFolder folder;
  {
    const auto workshop = Workshop::open(folder / "results");
    ASSERT_TRUE(workshop);
    put(workshop->folder() / "a.txt", "half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "results"));
}

TEST(Workshop, OneThatAKilledProgramLeftIsRemovedAndOneInUseIsNot) {
  const test::TempFolder folder;
  std::filesystem::create_directories(folder / ".unfinished_killed/figures");
  const auto first = Workshop::open(folder.path());
  ASSERT_TRUE(first);
  EXPECT_FALSE(std::filesystem::exists(folder / ".unfinished_killed"));
  const auto second = Workshop::open(folder.path());
  ASSERT_TRUE(second);
  EXPECT_TRUE(std::filesystem::exists(first->folder()));
}

TEST(Workshop, DeliveredFilesAndFoldersTakeThePlaceOfOlderOnes) {
  const test::TempFolder folder;
  std::filesystem::create_directories(folder / "figures");
  folder.put("figures/old.png", "old");
  folder.put("a.txt", "old");
  folder.put("other.txt", "kept");
  {
    const auto workshop = Workshop::open(folder.path());
    ASSERT_TRUE(workshop);
    put(workshop->folder() / "a.txt", "new");
    std::filesystem::create_directories(workshop->folder() / "figures");
    put(workshop->folder() / "figures/new.png", "new");
    ASSERT_TRUE(workshop->deliver(std::array<std::string, 2>{"figures", "a.txt"}));
  }
  EXPECT_EQ(content(folder / "a.txt"), "new");
  EXPECT_EQ(content(folder / "figures/new.png"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/old.png"));
  EXPECT_EQ(content(folder / "other.txt"), "kept");
}

TEST(Workshop, OlderResultsThatAreNotMadeAgainGo) {
  const test::TempFolder folder;
  std::filesystem::create_directories(folder / "figures");
  {
    const auto workshop = Workshop::open(folder.path());
    ASSERT_TRUE(workshop);
    workshop->discard_older(std::array<std::string, 2>{"figures", "never_there"});
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Workshop, FolderThatCannotBeMadeIsNamed) {
  const auto workshop = Workshop::open("/proc/none");
  ASSERT_FALSE(workshop);
  EXPECT_THAT(to_string(workshop.error()), HasSubstr("/proc/none: cannot make this folder"));
}

}  // namespace workshop_test
}  // namespace twin::pictures
