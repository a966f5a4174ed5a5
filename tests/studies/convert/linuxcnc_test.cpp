#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "programs.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::convert {
namespace linuxcnc_test {

/// What a shell command writes, and how it ends.
struct Outcome {
  std::string text;
  int status = -1;
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) {
    return outcome;
  }
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.text.append(buffer.data(), n);
  }
  outcome.status = pclose(pipe);
  return outcome;
}

/// LinuxCNC's stand-alone interpreter, package linuxcnc-uspace.
class LinuxCnc : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (run("command -v rs274").status != 0) {
      GTEST_SKIP() << "rs274 is not installed";
    }
    file = folder.put("made.ngc", test::convert_file(GetParam(), "g5.2").text);
  }

  test::TempFolder folder;
  std::filesystem::path file;
};

TEST_P(LinuxCnc, TakesTheProgramWithItsNurbs) {
  const Outcome outcome = run(fmt::format("rs274 -g {}", file.string()));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  std::int64_t count = 0;
  for (std::size_t at = 0; (at = outcome.text.find("NURBS_FEED", at)) != std::string::npos; ++at) {
    ++count;
  }
  EXPECT_EQ(count, test::convert_file(GetParam(), "g5.2").nurbs.blocks);
}

TEST_P(LinuxCnc, PointsOfItsCurvesStayWithinTheTolerance) {
  if (run("/usr/bin/python3 -c 'import gcode; gcode.parse'").status != 0) {
    GTEST_SKIP() << "LinuxCNC's module gcode is not installed";
  }
  const Outcome outcome =
      run(fmt::format("/usr/bin/python3 {}/tests/studies/convert/linuxcnc_points.py {} {}",
                      TWIN_SOURCE_DIR, file.string(), (folder / "linuxcnc.var").string()));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  std::vector<Vec3> points;
  std::istringstream lines(outcome.text);
  for (std::string line; std::getline(lines, line);) {
    Vec3 p;
    if (std::sscanf(line.c_str(), "%lf %lf %lf", &p.x(), &p.y(), &p.z()) == 3) {
      points.push_back(p);
    }
  }
  ASSERT_GT(points.size(), 1000U) << outcome.text.substr(0, 400);
  const auto before = test::blocks_of(*gcode::Reader::open(test::program_path(GetParam())));
  EXPECT_LE(test::distance_along(points, test::points_of(before, 0.02)), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Programs, LinuxCnc, testing::Values("dolphin.nc", "oxalis.nc"),
                         [](const auto& param) {
                           return param.param.substr(0, param.param.find('.'));
                         });

}  // namespace linuxcnc_test
}  // namespace twin::studies::convert
