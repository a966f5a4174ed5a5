#pragma once

#include <string>
#include <vector>

#include "nc_programs/generate/linearise.hpp"
#include "nc_programs/generate/nc_text.hpp"

namespace twin::programs {

/// What it takes to make a program of a closed figure.
struct OutlineSpec {
  std::string name;   ///< file name
  std::string title;  ///< for the header comment
  std::vector<std::vector<Point2>>
      sketch;               ///< points of each curve from corner to corner, any unit
  double smoothing;         ///< lambda of FairCurve, in that unit
  RoundShape round;         ///< of every corner
  ChordTarget chords;       ///< count, shortest and longest block
  double mean_length;       ///< mean block length [mm]; count x mean fixes the size
  double path_length;       ///< of the whole program, approach and return included [mm]
  std::size_t start_curve;  ///< the path starts on this curve
  double start_fraction;    ///< at this fraction of its length, 0..1
  double approach_side;     ///< +1: X0 Y0 lies to the left of the outline, -1: to the right
};

/// Sized, rounded and linearised outline of the spec, first point at the start.
struct OutlineResult {
  Chords chords;
  Point2 origin;  ///< X0 Y0 in the outline's coordinates [mm]
  double scale;   ///< mm per unit of the sketch
};

OutlineResult solve_outline(const OutlineSpec& spec);

/// The program: X0 Y0 -> start (straight, square to the outline), once around, straight back; all
/// G01.
ProgramFile outline_program(const OutlineSpec& spec);

}  // namespace twin::programs
