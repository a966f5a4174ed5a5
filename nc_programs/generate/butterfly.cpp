#include "nc_programs/generate/programs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace twin::programs {
namespace {

const std::vector<Point2> kPoints = {
    {54.493, 52.139}, {55.507, 52.139}, {56.082, 49.615},  {56.780, 44.971},  {69.575, 51.358},
    {77.786, 58.573}, {90.526, 67.081}, {105.973, 63.801}, {100.400, 47.326}, {94.567, 39.913},
    {92.369, 30.485}, {83.440, 33.757}, {91.892, 28.509},  {89.444, 20.393},  {83.218, 15.446},
    {87.621, 4.830},  {80.945, 9.267},  {79.834, 14.535},  {76.074, 8.522},   {70.183, 12.550},
    {64.171, 16.865}, {59.993, 22.122}, {55.680, 36.359},  {56.925, 24.995},  {59.765, 19.828},
    {54.493, 14.940}, {49.220, 19.828}, {52.060, 24.994},  {53.305, 36.359},  {48.992, 22.122},
    {44.814, 16.865}, {38.802, 12.551}, {32.911, 8.521},   {29.152, 14.535},  {28.040, 9.267},
    {21.364, 4.830},  {25.768, 15.447}, {19.539, 20.391},  {17.097, 28.512},  {25.537, 33.750},
    {16.602, 30.496}, {14.199, 39.803}, {8.668, 47.408},   {3.000, 63.794},   {18.465, 67.084},
    {31.197, 58.572}, {39.411, 51.358}, {52.204, 44.971},  {52.904, 49.614},  {53.478, 52.139},
    {54.492, 52.139}};  ///< [mm]

const std::vector<double> kKnots = {
    0,      0,      0,      0,      0.0083, 0.0150, 0.0361, 0.0855, 0.1293, 0.1509, 0.1931,
    0.2273, 0.2435, 0.2561, 0.2692, 0.2889, 0.3170, 0.3316, 0.3482, 0.3553, 0.3649, 0.3837,
    0.4005, 0.4269, 0.4510, 0.4660, 0.4891, 0.5000, 0.5109, 0.5340, 0.5489, 0.5731, 0.5994,
    0.6163, 0.6351, 0.6447, 0.6518, 0.6683, 0.6830, 0.7111, 0.7307, 0.7439, 0.7565, 0.7729,
    0.8069, 0.8491, 0.8707, 0.9145, 0.9639, 0.9850, 0.9917, 1,      1,      1,      1};

std::vector<double> weights() {
  std::vector<double> w(kPoints.size(), 1.0);
  w[3] = w[47] = 1.2;
  w[11] = w[39] = 2.0;
  w[14] = w[36] = 5.0;
  w[15] = w[35] = 3.0;
  w[17] = w[33] = 1.1;
  return w;
}

constexpr double kTolerance = 0.0009;  ///< 1 um less what rounding to 4 decimals can add [mm]
constexpr double kLongest = 1.0;       ///< [mm]

}  // namespace

RationalCurve butterfly_curve() { return {3, kPoints, weights(), kKnots}; }

ProgramFile butterfly_program() {
  std::vector<Point2> points = linearise(butterfly_curve(), kTolerance, kLongest);
  for (Point2& p : points) {
    p = round_to_file(p);
  }
  double sum = 0.0;
  double shortest = 1e9;
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double l = (points[i] - points[i - 1]).norm();
    sum += l;
    shortest = std::min(shortest, l);
    longest = std::max(longest, l);
  }
  const std::size_t n = points.size() - 1;
  NcText nc;
  nc.comment(
      "butterfly: published NURBS of degree 3, 51 control points, chord deviation 1 um at most");
  nc.comment(
      fmt::format("curve: {} blocks, length max {:.3f} min {:.3f} mean {:.3f} mm, sum {:.3f} mm", n,
                  longest, shortest, sum / static_cast<double>(n), sum));
  nc.comment("straight approach from X0 Y0 and straight return");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  for (const Point2& p : points) {
    nc.line_to(p);
  }
  nc.line_to(Point2::Zero());
  return {"butterfly.nc", nc.end_of_program()};
}

ProgramFile butterfly_nurbs_program() {
  const std::vector<double> w = weights();
  NcText nc;
  nc.comment("butterfly: published NURBS of degree 3, 51 control points, as G06.2");
  nc.comment("K knot, R weight; straight approach from X0 Y0 and straight return");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  nc.line_to(kPoints.front());
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    nc.raw(fmt::format("{}K{:g} X{:.3f} Y{:.3f} R{:g}", i == 0 ? "G06.2 P4 " : "", kKnots[i],
                       kPoints[i].x(), kPoints[i].y(), w[i]));
  }
  for (std::size_t i = kPoints.size(); i < kKnots.size(); ++i) {
    nc.raw(fmt::format("K{:g}", kKnots[i]));
  }
  nc.raw("G01");
  nc.line_to(Point2::Zero());
  return {"butterfly_nurbs.nc", nc.end_of_program()};
}

}  // namespace twin::programs
