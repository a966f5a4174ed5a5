#include <cmath>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {
namespace {

/// The dolphin stretched out straight: x from the tip of the beak (0) to the flukes (about 100), y
/// up.
const std::vector<std::vector<Point2>> kStraight = {
    // beak, forehead, back, front of the dorsal fin
    {{0.0, 0.0},
     {3.5, 1.3},
     {7.0, 2.1},
     {9.9, 3.0},
     {11.4, 4.9},
     {13.3, 7.2},
     {16.4, 9.1},
     {21.0, 10.6},
     {27.0, 11.7},
     {33.5, 12.3},
     {39.5, 12.9},
     {44.0, 14.3},
     {48.0, 16.7},
     {52.5, 19.5},
     {58.5, 21.0}},
    // rear of the dorsal fin
    {{58.5, 21.0}, {55.6, 18.4}, {54.2, 15.0}, {54.8, 11.4}},
    // back behind the fin, tail stock, front of the upper fluke
    {{54.8, 11.4},
     {62.0, 10.0},
     {69.0, 7.9},
     {76.0, 5.3},
     {82.5, 3.0},
     {88.0, 2.0},
     {92.0, 2.8},
     {95.0, 5.6},
     {98.8, 10.0},
     {106.0, 14.2}},
    // rear of the upper fluke
    {{106.0, 14.2}, {104.4, 9.6}, {103.4, 5.0}, {100.4, 1.0}},
    // rear of the lower fluke
    {{100.4, 1.0}, {103.8, -2.6}, {105.4, -7.2}, {108.2, -12.4}},
    // front of the lower fluke, tail stock, belly
    {{108.2, -12.4},
     {100.8, -9.0},
     {96.6, -5.0},
     {92.8, -2.3},
     {88.0, -1.5},
     {82.5, -2.3},
     {76.0, -4.6},
     {68.0, -7.8},
     {60.0, -10.9},
     {52.0, -12.9},
     {44.0, -13.7},
     {36.8, -12.9}},
    // rear of the flipper
    {{36.8, -12.9}, {38.9, -16.0}, {41.0, -20.0}, {43.2, -26.4}},
    // front of the flipper, throat, lower jaw
    {{43.2, -26.4},
     {36.2, -22.9},
     {31.6, -18.4},
     {28.6, -14.5},
     {25.2, -12.0},
     {20.5, -10.2},
     {15.5, -7.8},
     {11.0, -5.0},
     {7.0, -2.9},
     {3.5, -1.7},
     {0.0, 0.0}}};

constexpr double kBendRadius = 78.0;  ///< of the arched middle line, in the same unit
constexpr double kMiddle = 50.0;      ///< x at the top of the arch

/// Bends the middle line y = 0 onto a circle; the beak looks to the right.
Point2 bent(const Point2& p) {
  const double angle = (kMiddle - p.x()) / kBendRadius;
  const double r = kBendRadius + p.y();
  return {r * std::sin(angle), r * std::cos(angle) - kBendRadius};
}

}  // namespace

OutlineSpec dolphin() {
  OutlineSpec spec;
  spec.name = "dolphin.nc";
  spec.title = "dolphin: leaping, from the side";
  for (const auto& curve : kStraight) {
    std::vector<Point2> points;
    points.reserve(curve.size());
    for (const Point2& p : curve) {
      points.push_back(bent(p));
    }
    spec.sketch.push_back(points);
  }
  spec.smoothing = 1.0;
  spec.round = {1.05, 1.0};
  spec.chords = {1221, 0.106, 0.743};
  spec.mean_length = 0.329;
  spec.path_length = 453.75;
  spec.start_curve = 2;
  spec.start_fraction = 0.4;
  spec.approach_side = -1.0;
  return spec;
}

}  // namespace twin::programs
