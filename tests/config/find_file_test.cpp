#include "config/find_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace twin::config {
namespace find_file_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FindFile : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / ("find_file_" + std::to_string(getpid()));
    fs::create_directories(root_ / "first");
    fs::create_directories(root_ / "second" / "folder.nc");
    write("first/circle.nc");
    write("second/circle.nc");
    write("second/dolphin.nc");
    write("second/notes.txt");
    folders_ = {root_ / "first", root_ / "second"};
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name) { std::ofstream(root_ / name) << name; }
  Expected<fs::path> find(const std::string& name) {
    return find_file("NC program", name, ".nc", folders_);
  }
  std::string refusal(const std::string& name) {
    const auto found = find(name);
    EXPECT_FALSE(found) << name;
    return found ? "" : to_string(found.error());
  }

  fs::path root_;
  std::vector<fs::path> folders_;
};

TEST_F(FindFile, APathWinsOverTheFolders) {
  const std::string path = (root_ / "second" / "circle.nc").string();
  EXPECT_EQ(find(path).value(), path);
}

TEST_F(FindFile, EarlierFoldersWinOverLaterOnes) {
  EXPECT_EQ(find("circle.nc").value(), root_ / "first" / "circle.nc");
  EXPECT_EQ(find("dolphin.nc").value(), root_ / "second" / "dolphin.nc");
}

TEST_F(FindFile, TheExtensionMayBeLeftOut) {
  EXPECT_EQ(find("dolphin").value(), root_ / "second" / "dolphin.nc");
}

TEST_F(FindFile, NamesWithAFolderAreNotLookedUp) {
  EXPECT_THAT(refusal("no_such/dolphin.nc"), HasSubstr("no such NC program"));
}

TEST_F(FindFile, RefusalsSayWhereAndSuggestTheNearest) {
  const std::string message = refusal("dolfin.nc");
  EXPECT_THAT(message, HasSubstr(folders_[0].string()));
  EXPECT_THAT(message, HasSubstr(folders_[1].string()));
  EXPECT_THAT(message, HasSubstr("did you mean dolphin.nc?"));
}

TEST_F(FindFile, ADirectoryIsNoProgram) {
  EXPECT_THAT(refusal(root_.string()), HasSubstr("is a directory, not a file"));
  refusal("folder.nc");
  refusal("");
}

TEST_F(FindFile, MissingFoldersAreLeftOut) {
  EXPECT_TRUE(data_folders("no_such_folder_anywhere").empty());
}

}  // namespace find_file_test
}  // namespace twin::config
