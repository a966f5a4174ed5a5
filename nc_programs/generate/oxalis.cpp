#include <cmath>
#include <numbers>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {
namespace {

/// Right half of a leaflet that points up, from the corner at the centre to the notch.
const std::vector<Point2> kHalfLeaflet = {{1.90, 1.10}, {4.2, 4.9},   {7.3, 9.8},   {10.8, 14.8},
                                          {13.7, 19.8}, {14.5, 24.6}, {12.2, 28.6}, {8.0, 29.8},
                                          {3.9, 27.8},  {0.0, 22.6}};

Point2 rotated(const Point2& p, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

}  // namespace

OutlineSpec oxalis() {
  OutlineSpec spec;
  spec.name = "oxalis.nc";
  spec.title = "oxalis: three heart-shaped leaflets";
  for (int leaflet = 0; leaflet < 3; ++leaflet) {
    const double turn = 2.0 * std::numbers::pi / 3.0 * leaflet;
    std::vector<Point2> right;
    std::vector<Point2> left;
    for (const Point2& p : kHalfLeaflet) {
      right.push_back(rotated(p, turn));
      left.insert(left.begin(), rotated({-p.x(), p.y()}, turn));
    }
    spec.sketch.push_back(right);
    spec.sketch.push_back(left);
  }
  spec.smoothing = 20.0;
  spec.round = {1.05, 1.0};
  spec.chords = {1006, 0.091, 0.580};
  spec.mean_length = 0.262;
  spec.path_length = 309.0;
  spec.start_curve = 4;
  spec.start_fraction = 0.43;
  spec.approach_side = -1.0;
  return spec;
}

}  // namespace twin::programs
