#include "hal/mujoco/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hal/mujoco/mujoco_library.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/files.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::mujoco {
namespace model_test {

using test::content;
using ::testing::HasSubstr;

/// Configures a table from MJCF text and returns the error.
Error error_of(const std::string& mjcf) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string file = ::testing::TempDir() + "twin_" + info->name() + ".xml";
  std::ofstream(file) << mjcf;
  TableParams params;
  params.model = file;
  MujocoMachine machine(params);
  const Expected<void> result = checked(machine.configure(1e-3));
  std::filesystem::remove(file);
  EXPECT_FALSE(result);
  if (result) {
    return {};
  }
  EXPECT_EQ(result.error().code, ErrorCode::kModel);
  EXPECT_EQ(result.error().file, file);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  EXPECT_EQ(machine.state(), State::kUnconfigured);
  return result.error();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string table_text() { return content(test::mjcf_file("xy_table.xml")); }

TEST(Model, MissingFileIsNamed) {
  const auto model = load_model("/nowhere/table.xml");
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::kModel);
  EXPECT_EQ(model.error().file, "/nowhere/table.xml");
  EXPECT_THAT(model.error().message, HasSubstr("no such MJCF file"));
}

TEST(Model, FolderIsNoModel) { EXPECT_FALSE(load_model(::testing::TempDir())); }

TEST(Model, BrokenXmlIsAnErrorAndNotTheEnd) {
  EXPECT_THAT(error_of("<mujoco><worldbody>").message, HasSubstr("MuJoCo cannot load it"));
}

TEST(Model, EmptyAndBinaryFilesAreErrors) {
  error_of("");
  error_of(std::string("\x7f\x45\x4c\x46\x00\x01\xff\xfe", 8));
}

TEST(Model, UnknownElementIsReportedInMujocosWords) {
  EXPECT_THAT(error_of(replaced(table_text(), "<worldbody>", "<nonsense/><worldbody>")).message,
              HasSubstr("nonsense"));
}

TEST(Model, MissingJointIsNamed) {
  EXPECT_THAT(error_of(replaced(table_text(), "<joint name=\"x\"", "<joint name=\"xx\"")).message,
              HasSubstr("no joint named \"x\""));
  EXPECT_THAT(error_of(replaced(table_text(), "<joint name=\"z\"", "<joint name=\"up\"")).message,
              HasSubstr("no joint named \"z\""));
}

TEST(Model, HingeInPlaceOfASlideIsRefused) {
  EXPECT_THAT(
      error_of(replaced(table_text(), "<joint name=\"y\"", "<joint name=\"y\" type=\"hinge\""))
          .message,
      HasSubstr("joint \"y\" of the model is not a slide joint"));
}

TEST(Model, TableOfTheRepositoryHasThreeJointsAndNoGeomsInPhysics) {
  const auto model = load_model(test::mjcf_file("xy_table.xml"));
  ASSERT_TRUE(model);
  EXPECT_EQ((*model)->nv, 3);
  EXPECT_EQ((*model)->ngeom, 0);
}

TEST(Model, ErrorsOfMujocoBecomeExceptions) {
  ASSERT_TRUE(MujocoLibrary::load());
  EXPECT_THROW(mju_error("told to fail"), MujocoError);
}

}  // namespace model_test
}  // namespace twin::hal::mujoco
