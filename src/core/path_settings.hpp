#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace twin {

/// What runs of continuous short blocks become: path.curves of the machine file.
enum class CurveKind : std::uint8_t {
  kNurbs,   ///< C2 cubic NURBS curves
  kBezier,  ///< cubic Bezier pieces with continuous tangent (Fast Bezier interpolation)
  kNone,    ///< the lines they are
};

/// Which planner turns blocks into a path with feedrates: planning.planner of the machine file.
enum class Planner : std::uint8_t {
  kPaper,      ///< runs of short blocks interpolated, corners passed as they are [WY09]
  kCertified,  ///< one path of continuous curvature within the tolerance, all limits guaranteed
};

/// How the certified planner passes the corner between two lines where the jerk is limited as a
/// vector: planning.corners.
enum class CornerKind : std::uint8_t {
  kCurve,    ///< on a curve of continuous curvature, at the feedrate that it allows
  kPassage,  ///< by a motion in time whose jerk is limited as a vector (path::CornerMotion)
};

/// Names of the kinds of corners, in the order of CornerKind.
inline constexpr std::array<std::string_view, 2> kCornerNames{"curve", "passage"};

/// Names of the kinds of curves, in the order of CurveKind.
inline constexpr std::array<std::string_view, 3> kCurveNames{"nurbs", "bezier", "linear"};

/// Names of the planners, in the order of Planner.
inline constexpr std::array<std::string_view, 2> kPlannerNames{"paper", "certified"};

/// How NC blocks become segments: which runs are fitted, how closely, and how far ahead the planner
/// looks.
struct PathSettings {
  Planner planner = Planner::kCertified;  ///< the one that plans: see config::resolve_planner
  CurveKind curves = CurveKind::kNurbs;
  CornerKind corners = CornerKind::kPassage;
  double chord_error = 0.01;  ///< chord tolerance, and the curve's distance from the polygon [mm]
  int min_segments = 3;       ///< fewest blocks that are fitted into one curve
  int max_segments = 20;      ///< most blocks in one curve
  double short_block_length = 10.0;  ///< a longer block is never part of a run of short ones [mm]
  int look_ahead = 200;              ///< planned segments between planner and interpolator
};

}  // namespace twin
