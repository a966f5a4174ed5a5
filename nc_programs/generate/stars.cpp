#include <cmath>
#include <numbers>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {
namespace {

/// Lines through the ten corners of a star of five points and back to the first.
///
/// The inner corners lie on the diagonals of the pentagon: r_inner / r_outer = cos 72 / cos 36.
/// @param longest  of a block [mm]
void star(NcText& nc, const Point2& centre, double outer, double turned, double longest) {
  const double inner = outer * std::cos(0.4 * std::numbers::pi) / std::cos(0.2 * std::numbers::pi);
  Point2 before = Point2::Zero();
  for (int i = 0; i <= 10; ++i) {
    const double r = i % 2 == 0 ? outer : inner;
    const double angle = turned + 0.2 * std::numbers::pi * i;
    const Point2 corner = centre + r * Point2(std::cos(angle), std::sin(angle));
    const int blocks =
        i == 0 ? 1 : std::max(1, static_cast<int>(std::lround((corner - before).norm() / longest)));
    for (int k = 1; k < blocks; ++k) {
      nc.line_to(before + (corner - before) * k / blocks);
    }
    nc.line_to(corner);
    before = corner;
  }
}

}  // namespace

ProgramFile zigzag_program() {
  NcText nc;
  nc.comment("zigzag: 1000 blocks of 0.1 mm, each at 90 deg to the one before");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  const double side = 0.1 / std::numbers::sqrt2;  // of a block, in X and in Y [mm]
  for (int i = 1; i <= 1000; ++i) {
    nc.line_to({side * i, i % 2 == 1 ? side : 0.0});
  }
  return {"zigzag.nc", nc.end_of_program()};
}

ProgramFile star_program() {
  NcText nc;
  nc.comment("star: five points of 36 deg, in blocks of 0.5 mm; then a smaller one in whole lines");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  star(nc, Point2::Zero(), 30.0, 0.5 * std::numbers::pi, 0.5);
  star(nc, Point2::Zero(), 12.0, -0.5 * std::numbers::pi, 100.0);
  nc.line_to(Point2::Zero());
  return {"star.nc", nc.end_of_program()};
}

}  // namespace twin::programs
