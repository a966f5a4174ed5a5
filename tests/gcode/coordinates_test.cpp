#include "gcode/interpreter/coordinates.hpp"

#include <gtest/gtest.h>

#include <random>

#include "program.hpp"

namespace twin::gcode {
namespace coordinates_test {

TEST(Coordinates, ProgramOfIsTheInverseOfMachineOf) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-50.0, 50.0);
  const auto place = [&] { return Vec3(number(random), number(random), number(random)); };
  for (int i = 0; i < 1000; ++i) {
    Coordinates frame;
    frame.place_workpiece(place());
    frame.store(3, {place(), 3.0 * number(random)});
    frame.select(3);
    frame.set_shift(place(), i % 2 == 0);
    frame.set_tool(place());
    frame.set_rotation({rotation_about(i % 3, number(random)), place(), true});
    frame.set_scaling(
        {Eigen::DiagonalMatrix<double, 3>(-1.0, 1.0, 1.0).toDenseMatrix(), place(), i % 5 == 0});
    const Vec3 program = place();
    EXPECT_NEAR((frame.program_of(frame.machine_of(program)) - program).norm(), 0.0, 1e-11);
    EXPECT_EQ(frame.is_mirrored(), i % 5 == 0);
  }
}

TEST(Coordinates, ArcsGoThroughTheirMovedPoints) {
  Coordinates frame;
  frame.store(0, {Vec3(7.0, -3.0, 2.0), 31.0});
  frame.set_scaling({Eigen::DiagonalMatrix<double, 3>(1.0, -1.0, 1.0).toDenseMatrix(),
                     Vec3(1.0, 2.0, 3.0), true});
  geometry::Arc arc;
  arc.centre = Vec3(1.0, 2.0, 3.0);
  arc.radius = 4.0;
  arc.radius_change = 0.01;
  arc.sweep = 5.0;
  arc.rise = 2.0;
  const geometry::Arc moved = frame.machine_arc(arc);
  for (const double fraction : {0.0, 0.3, 0.7, 1.0}) {
    EXPECT_NEAR(
        (geometry::point_at(moved, fraction) - frame.machine_of(geometry::point_at(arc, fraction)))
            .norm(),
        0.0, 1e-12);
  }
}

TEST(Coordinates, QuartersOfATurnAreExact) {
  EXPECT_EQ(Vec3(rotation_about(2, 90.0) * Vec3::UnitX()), Vec3::UnitY().eval());
  EXPECT_EQ(Vec3(rotation_about(2, -270.0) * Vec3::UnitX()), Vec3::UnitY().eval());
  EXPECT_EQ(Vec3(rotation_about(1, 180.0) * Vec3::UnitZ()), Vec3(-Vec3::UnitZ()));
}

TEST(Coordinates, TheWorkpieceMovesAllButMachineCoordinates) {
  ReaderOptions options;
  options.workpiece = Vec3(10.0, 20.0, 5.0);
  const auto blocks = blocks_of("G0 X1 Y1\nG53 G0 X1\nG55 Y0\n", options);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].end, Vec3(11.0, 21.0, 0.0));
  EXPECT_EQ(blocks[1].end, Vec3(1.0, 21.0, 0.0));
  EXPECT_EQ(blocks[2].end, Vec3(1.0, 20.0, 0.0));
}

TEST(Coordinates, ParametersReadAndWriteThem) {
  const auto blocks = blocks_of("G10 L2 P2 X5\n#1=[#5241 + 1]\nG0 X#1\n#5242=7\nG55 Y0\n");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].end.x(), 6.0);
  EXPECT_EQ(blocks[1].end.y(), 7.0);
}

TEST(WorkOffsets, G154OfHaasIsG541) {
  for (const std::string word : {"G54.1 P3", "G154 P3"}) {
    const auto blocks = blocks_of(word + "\nG0 X1");
    ASSERT_EQ(blocks.size(), 1U) << word;
    EXPECT_EQ(blocks[0].work_offset, 11) << word;  // behind the nine of G54 to G59.3
  }
}

}  // namespace coordinates_test
}  // namespace twin::gcode
