#include "nc_programs/generate/programs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace twin::programs {
namespace {

constexpr double kDegreeInRadians = std::numbers::pi / 180.0;  ///< [rad]

void lines(NcText& nc, std::initializer_list<const char*> text) {
  for (const char* line : text) {
    nc.raw(line);
  }
}

/// The sine y = 3 sin(2 pi (x + 45) / 20) along +X in chords of equal length [mm].
///
/// Block by block the next x is solved from (dx)^2 + (dy)^2 = chord^2.
/// @param x  where the run starts [mm]
/// @returns x where it ends [mm]
double sine_run(NcText& nc, double x, int blocks, double chord) {
  const auto y = [](double at) {
    return 3.0 * std::sin(2.0 * std::numbers::pi * (at + 45.0) / 20.0);
  };
  for (int i = 0; i < blocks; ++i) {
    double low = x;
    double high = x + chord;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (std::hypot(middle - x, y(middle) - y(x)) < chord ? low : high) = middle;
    }
    x = low;
    nc.line_to({x, y(x)});
  }
  return x;
}

}  // namespace

ProgramFile circle_program() {
  NcText nc;
  nc.comment(
      "circle: radius 20 mm about X0 Y0, both senses, at 3000 and 1000 mm/min; arcs by I J and by "
      "R");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  lines(nc, {"X20.0000 Y0.0000", "(full circle, counter-clockwise, then clockwise)",
             "G03 X20.0000 Y0.0000 I-20.0000 J0.0000", "G02 X20.0000 Y0.0000 I-20.0000 J0.0000",
             "(the same at a third of the feedrate)", "G03 I-20.0000 J0.0000 F1000",
             "G02 I-20.0000 J0.0000", "(quarter arcs, counter-clockwise: R, R, I J, I J)",
             "G03 X0.0000 Y20.0000 R20.0000 F3000", "X-20.0000 Y0.0000 R20.0000",
             "X0.0000 Y-20.0000 I20.0000 J0.0000", "X20.0000 Y0.0000 I0.0000 J20.0000",
             "(three quarters and a quarter, clockwise: R below zero is the longer arc)",
             "G02 X0.0000 Y20.0000 R-20.0000", "G02 X20.0000 Y0.0000 R20.0000",
             "(half circles of 10 mm, one of each sense)", "G03 X0.0000 Y0.0000 R10.0000",
             "G02 X-20.0000 Y0.0000 I-10.0000 J0.0000", "G01 X0.0000 Y0.0000"});
  return {"circle.nc", nc.end_of_program()};
}

ProgramFile square_program() {
  NcText nc;
  nc.comment(
      "square: 40 mm, then a zigzag with corner angles of 165, 150, .. 15 deg; 180 deg is straight "
      "on");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  lines(nc, {"X40.0000", "Y40.0000", "X0.0000", "Y0.0000", "X-20.0000 Y-15.0000", "(zigzag)"});
  const double leg = 12.0;  // [mm]
  Point2 p(-20.0, -15.0);
  double heading = 0.0;
  double sense = 1.0;
  for (int corner = 165; corner >= 0; corner -= 15) {
    p += leg * Point2(std::cos(heading), std::sin(heading));
    nc.line_to(p);
    heading += sense * (180 - corner) * kDegreeInRadians;
    sense = -sense;
  }
  nc.line_to(Point2::Zero());
  return {"square.nc", nc.end_of_program()};
}

ProgramFile mixed_program() {
  NcText nc;
  nc.comment(
      "mixed: rapids, pen lifts, long lines, arcs, helix, short blocks, dwell, feedrates, G61, "
      "G91");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  lines(nc, {"G21 G17 G90 G94",
             "G64 P0.01",
             "G00 Z5.0000",
             "(frame with rounded corners)",
             "G00 X-50.0000 Y-40.0000",
             "G01 Z0.0000 F600",
             "G01 X50.0000 F3000",
             "G03 X60.0000 Y-30.0000 I0.0000 J10.0000",
             "G01 Y30.0000",
             "G03 X50.0000 Y40.0000 R10.0000",
             "G01 X-50.0000",
             "G03 X-60.0000 Y30.0000 R10.0000",
             "G01 Y-30.0000 F1500",
             "G03 X-50.0000 Y-40.0000 I10.0000 J0.0000",
             "G00 Z5.0000",
             "(helix down to the plate, then a full circle)",
             "G00 X6.0000 Y20.0000",
             "G01 Z2.0000 F600",
             "G03 X6.0000 Y20.0000 Z0.0000 I-6.0000 J0.0000 F1500",
             "G03 X6.0000 Y20.0000 I-6.0000 J0.0000 F3000",
             "G00 Z5.0000",
             "G04 P0.2",
             "(sine of 0.2 mm blocks)",
             "G00 X-45.0000 Y0.0000",
             "G01 Z0.0000 F600",
             "G01 F3000"});
  const double x = sine_run(nc, -45.0, 200, 0.2);
  lines(nc, {"(the run goes on at half the feedrate)", "F1500"});
  sine_run(nc, x, 200, 0.2);
  lines(nc, {"G00 Z5.0000", "(exact stop at every corner)", "G00 X-20.0000 Y-30.0000",
             "G01 Z0.0000 F600", "G61", "G01 X-10.0000 Y-15.0000 F3000", "X0.0000 Y-30.0000",
             "X10.0000 Y-15.0000", "X20.0000 Y-30.0000", "G64 P0.01", "(incremental)", "G91",
             "G01 X10.0000 Y0.0000", "X0.0000 Y10.0000", "X-10.0000 Y-10.0000", "G90",
             "G00 Z5.0000", "G00 X0.0000 Y0.0000", "G00 Z0.0000"});
  return {"mixed.nc", nc.end_of_program()};
}

}  // namespace twin::programs
