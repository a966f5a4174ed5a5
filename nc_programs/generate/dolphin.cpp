#include <cmath>

#include "nc_programs/generate/shapes.hpp"

namespace twin::programs {
namespace {

/// The dolphin stretched out straight: x from the tip of the beak (0) to the flukes (about 100), y
/// up.
const std::vector<std::vector<Point2>> kStraight = {
    // beak, forehead, back, front of the dorsal fin
    {{0.0, 0.0},
     {4.0, 1.2},
     {8.0, 2.7},
     {10.2, 4.6},
     {13.0, 7.2},
     {17.0, 9.2},
     {23.0, 10.6},
     {30.0, 11.6},
     {36.5, 12.2},
     {41.5, 13.2},
     {46.0, 15.6},
     {50.5, 19.2},
     {57.0, 22.4}},
    // rear of the dorsal fin
    {{57.0, 22.4}, {55.0, 19.4}, {54.3, 16.0}, {55.6, 11.2}},
    // back behind the fin, tail stock, front of the upper fluke
    {{55.6, 11.2},
     {63.0, 9.8},
     {70.0, 7.8},
     {77.0, 5.6},
     {84.0, 3.6},
     {90.0, 2.7},
     {94.5, 4.0},
     {98.0, 7.5},
     {104.5, 14.0}},
    // rear of the upper fluke
    {{104.5, 14.0}, {103.2, 9.0}, {102.4, 4.5}, {100.6, 0.3}},
    // rear of the lower fluke
    {{100.6, 0.3}, {103.0, -3.2}, {104.6, -7.5}, {107.0, -12.5}},
    // front of the lower fluke, tail stock, belly
    {{107.0, -12.5},
     {100.0, -7.6},
     {95.5, -3.4},
     {91.0, -1.4},
     {85.0, -1.9},
     {77.0, -3.9},
     {68.0, -6.3},
     {58.0, -8.7},
     {47.0, -10.3},
     {36.0, -10.3}},
    // rear of the flipper
    {{36.0, -10.3}, {37.2, -14.0}, {39.5, -18.0}, {43.5, -23.5}},
    // front of the flipper, throat, lower jaw
    {{43.5, -23.5},
     {36.0, -20.0},
     {30.5, -15.5},
     {26.5, -11.2},
     {21.5, -8.4},
     {15.0, -5.9},
     {9.0, -3.6},
     {4.5, -2.0},
     {0.0, 0.0}}};

constexpr double kBendRadius = 75.0;  ///< of the arched middle line, in the same unit
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
    for (const Point2& p : curve) {
      points.push_back(bent(p));
    }
    spec.sketch.push_back(points);
  }
  spec.smoothing = 20.0;
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
