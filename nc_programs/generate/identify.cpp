#include <fmt/format.h>

#include <array>
#include <numbers>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {
namespace {

/// There and back, several times: how far, how fast, how often.
struct Stroke {
  double length;               ///< of either axis [mm]
  double feedrate_mm_per_min;  ///< of either axis
  int times;                   ///< there and back
};

// From inside the bristle, over the Stribeck curve, to where mass and drive decide.
constexpr std::array<Stroke, 11> kStrokes{{{0.01, 6.0, 2},
                                           {0.03, 12.0, 2},
                                           {0.1, 30.0, 2},
                                           {0.2, 60.0, 2},
                                           {0.5, 120.0, 2},
                                           {1.0, 240.0, 1},
                                           {2.0, 600.0, 1},
                                           {5.0, 1800.0, 2},
                                           {20.0, 4800.0, 1},
                                           {60.0, 8400.0, 1},
                                           {3.0, 8400.0, 3}}};

}  // namespace

ProgramFile identify_program() {
  NcText nc;
  nc.comment("identify: X and Y alike, from slow strokes of 0.01 mm to fast ones, then circles");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  nc.raw("G61");
  nc.raw("G04 P0.2");
  for (const Stroke& stroke : kStrokes) {
    const double feedrate = stroke.feedrate_mm_per_min * std::numbers::sqrt2;  // along the diagonal
    nc.raw(fmt::format("F{:.1f}", feedrate));
    for (int i = 0; i < stroke.times; ++i) {
      nc.line_to({stroke.length, stroke.length});
      nc.line_to({0.0, 0.0});
    }
  }
  nc.raw("G04 P0.2");
  for (const char* line : {"G64", "G03 X0.0000 Y0.0000 I-20.0000 J0.0000 F6000",
                           "G02 X0.0000 Y0.0000 I-3.0000 J0.0000 F3000",
                           "G03 X0.0000 Y0.0000 I-1.0000 J0.0000 F600"}) {
    nc.raw(line);
  }
  return {"identify.nc", nc.end_of_program()};
}

}  // namespace twin::programs
