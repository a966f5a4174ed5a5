#include "nc_programs/generate/outline_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twin::programs {
namespace {

double polygon_length(const std::vector<Point2>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += (points[i] - points[i - 1]).norm();
  }
  return sum;
}

Outline build_outline(const std::vector<FairCurve>& curves, double scale, const RoundShape& shape) {
  std::vector<FairCurve> sized;
  sized.reserve(curves.size());
  for (const FairCurve& c : curves) {
    sized.push_back(c.scaled(scale));
  }
  return {sized, shape};
}

}  // namespace

OutlineResult solve_outline(const OutlineSpec& spec) {
  std::vector<FairCurve> curves;
  for (const auto& sketch : spec.sketch) {
    curves.emplace_back(sketch, spec.smoothing);
  }
  double sketch_length = 0.0;
  for (const FairCurve& c : curves) {
    sketch_length += c.end() - c.begin();
  }
  const double wanted = spec.chords.blocks * spec.mean_length;
  // Rounds keep their radius while the figure grows, so its length is not quite proportional to the
  // scale.
  double scale = wanted / sketch_length;
  double ratio = 2.0;
  for (int i = 0; i < 20 && std::abs(ratio - 1.0) > 1e-10; ++i) {
    ratio = wanted / build_outline(curves, scale, spec.round).length();
    scale *= ratio;
  }
  const Outline outline = build_outline(curves, scale, spec.round);
  const double start = outline.at_curve(spec.start_curve, spec.start_fraction);
  Chords chords = linearise(outline, spec.chords, start);
  const Frame f = outline.at(start);
  const double approach = 0.5 * (spec.path_length - polygon_length(chords.points));
  const Point2 left(-f.tangent.y(), f.tangent.x());
  const Point2 origin = chords.points.front() + spec.approach_side * approach * left;
  return {std::move(chords), origin, scale};
}

ProgramFile outline_program(const OutlineSpec& spec) {
  const OutlineResult solved = solve_outline(spec);
  std::vector<Point2> points;
  for (const Point2& p : solved.chords.points) {
    points.push_back(round_to_file(p - solved.origin));
  }
  double shortest = 1e9;
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double l = (points[i] - points[i - 1]).norm();
    shortest = std::min(shortest, l);
    longest = std::max(longest, l);
  }
  const double around = polygon_length(points);
  const double approach = points.front().norm();
  const int n = spec.chords.blocks;
  NcText nc;
  nc.comment(spec.title);
  nc.comment(
      fmt::format("outline: {} blocks, length max {:.3f} min {:.3f} mean {:.3f} mm, sum {:.3f} mm",
                  n, longest, shortest, around / n, around));
  nc.comment(fmt::format("approach and return {:.3f} mm each, whole path {:.3f} mm", approach,
                         around + 2.0 * approach));
  nc.comment(fmt::format("smooth outline, rounds of radius {:.3f} mm, chord tolerance {:.3f} um",
                         1.0 / spec.round.peak, 1000.0 * solved.chords.tolerance));
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  for (const Point2& p : points) {
    nc.line_to(p);
  }
  nc.line_to(Point2::Zero());
  return {spec.name, nc.end_of_program()};
}

}  // namespace twin::programs
