#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "gcode/block.hpp"
#include "path/path_builder.hpp"
#include "studies/convert/converter.hpp"
#include "studies/convert/program_deviation.hpp"

/// Conversions, and distances by brute force.
namespace twin::test {

inline std::string program_path(const std::string& name) {
  return (std::filesystem::path(TWIN_SOURCE_DIR) / "nc_programs" / name).string();
}

inline Expected<studies::convert::Conversion> convert_text(const std::string& text,
                                                           const std::string& dialect,
                                                           const PathSettings& settings = {}) {
  auto reader = gcode::Reader::from_text(text, "part.nc");
  return studies::convert::convert_program(
      reader, Vec3::Zero(), "part.nc", *studies::convert::make_dialect(dialect), settings, {}, {});
}

inline studies::convert::Conversion convert_file(const std::string& name,
                                                 const std::string& dialect) {
  auto reader = gcode::Reader::open(program_path(name));
  EXPECT_TRUE(reader);
  auto conversion = studies::convert::convert_program(
      *reader, Vec3::Zero(), name, *studies::convert::make_dialect(dialect), {}, {}, {});
  EXPECT_TRUE(conversion) << to_string(conversion.error());
  return conversion ? *conversion : studies::convert::Conversion{};
}

inline std::vector<gcode::Block> blocks_of(gcode::Reader reader) {
  std::vector<gcode::Block> blocks;
  for (;;) {
    auto block = reader.next();
    EXPECT_TRUE(block) << to_string(block.error());
    if (!block || !*block) {
      return blocks;
    }
    blocks.push_back(**block);
  }
}

inline std::vector<gcode::Block> blocks_of_text(const std::string& text) {
  return blocks_of(gcode::Reader::from_text(text, "made.nc"));
}

/// Segments the path builder makes of a program.
inline std::vector<path::Segment> segments_of(const std::string& name) {
  std::vector<path::Segment> segments;
  path::PathBuilder builder({}, {}, {},
                            [&](path::Segment&& s) { segments.push_back(std::move(s)); });
  for (const gcode::Block& block : blocks_of(*gcode::Reader::open(program_path(name)))) {
    builder.push(block);
  }
  builder.finish();
  return segments;
}

/// Points of a block, `step` mm apart or less [mm].
inline std::vector<Vec3> points_of(const gcode::Block& block, double step) {
  std::vector<Vec3> points;
  double length = (block.end - block.start).norm();
  if (block.motion == gcode::Motion::kArc) {
    length = std::hypot(block.arc.radius * block.arc.sweep, block.arc.rise);
  } else if (block.motion == gcode::Motion::kNurbs) {
    length = block.nurbs->arc_length.length();
  }
  const int count = std::max(1, static_cast<int>(std::ceil(length / step)));
  for (int i = 0; i <= count; ++i) {
    const double f = static_cast<double>(i) / count;
    if (block.motion == gcode::Motion::kNurbs) {
      const geometry::Curve& c = block.nurbs->curve;
      points.push_back(c.position(c.u_min() + f * (c.u_max() - c.u_min())));
    } else if (block.motion == gcode::Motion::kArc) {
      const geometry::Arc& a = block.arc;
      const Vec3 axis = a.e1.cross(a.e2);
      points.push_back(a.centre +
                       (a.radius + f * a.radius_change) *
                           (std::cos(f * a.sweep) * a.e1 + std::sin(f * a.sweep) * a.e2) +
                       f * a.rise * axis);
    } else {
      points.push_back(block.start + f * (block.end - block.start));
    }
  }
  return points;
}

inline std::vector<Vec3> points_of(const std::vector<gcode::Block>& blocks, double step) {
  std::vector<Vec3> points;
  for (const gcode::Block& block : blocks) {
    const auto more = points_of(block, step);
    points.insert(points.end(), more.begin(), more.end());
  }
  return points;
}

/// Distance of a point from the pieces of a polyline from `begin` to `end`, and the nearest one.
inline double distance_from(const Vec3& p, const std::vector<Vec3>& line, std::size_t begin,
                            std::size_t end, std::size_t& best) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < std::min(end, line.size() - 1); ++i) {
    const Vec3 way = line[i + 1] - line[i];
    const double squared = way.squaredNorm();
    const double f = squared > 0.0 ? std::clamp((p - line[i]).dot(way) / squared, 0.0, 1.0) : 0.0;
    const double d = (line[i] + f * way - p).squaredNorm();
    if (d < least) {
      least = d;
      best = i;
    }
  }
  return std::sqrt(least);
}

/// Largest distance of points from a polyline [mm], which they follow: the search stays near the
/// place of the point before, but for leaps.
inline double distance_along(const std::vector<Vec3>& points, const std::vector<Vec3>& line) {
  constexpr std::size_t kReach = 100;
  constexpr double kLeap = 0.2;  // [mm]
  double largest = 0.0;
  std::size_t at = 0;
  for (const Vec3& p : points) {
    std::size_t best = at;
    double least = distance_from(p, line, at - std::min(at, kReach), at + kReach, best);
    if (least > kLeap) {
      least = distance_from(p, line, 0, line.size(), best);
    }
    at = best;
    largest = std::max(largest, least);
  }
  return largest;
}

}  // namespace twin::test
