#include <cmath>
#include <numbers>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {

ProgramFile trochoid_program() {
  constexpr int kBlocks = 200000;
  constexpr double kGuide = 40.0;  // radius of the circle that the loops follow [mm]
  constexpr double kLoop = 2.0;    // radius of a loop [mm]
  constexpr double kBlock = 0.1;   // [mm]
  NcText nc;
  nc.comment(
      "trochoid: 200000 blocks of 0.1 mm, loops of radius 2 mm once round a circle of 40 mm");
  nc.comment("made by twin_generate_trochoid, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  constexpr double kTurn = kBlock / kLoop;  // of the loop in a block [rad]
  for (int i = 0; i < kBlocks; ++i) {
    const double along = 2.0 * std::numbers::pi * i / (kBlocks - 1);
    const Point2 centre = kGuide * Point2(std::cos(along), std::sin(along));
    nc.line_to(centre + kLoop * Point2(std::cos(kTurn * i), std::sin(kTurn * i)));
  }
  return {"trochoid.nc", nc.end_of_program()};
}

}  // namespace twin::programs
