#include <cmath>
#include <numbers>

#include "nc_programs/generate/programs.hpp"

namespace twin::programs {
namespace {

constexpr int kTeeth = 12;
constexpr double kModule = 4.0;                    // [mm]
constexpr double kPitch = 0.5 * kModule * kTeeth;  // radius of the pitch circle [mm]
constexpr double kTip = kPitch + kModule;          // [mm]
constexpr double kRoot = kPitch - 1.25 * kModule;  // [mm]
constexpr double kFillet = 1.0;                    // [mm]
constexpr double kPressureAngle = 20.0 * std::numbers::pi / 180.0;  // [rad]
constexpr double kBlock = 0.2;                                      // [mm]

double involute(double angle) { return std::tan(angle) - angle; }

Point2 polar(double r, double angle) { return r * Point2(std::cos(angle), std::sin(angle)); }

/// Angle between a tooth's middle and its flank at a radius from the base circle on:
/// pi / (2 z) + inv(alpha) - inv(acos(r_b / r)).
double half_tooth(double base, double r) {
  return std::numbers::pi / (2.0 * kTeeth) + involute(kPressureAngle) -
         involute(std::acos(std::min(base / r, 1.0)));
}

/// Writes a piece of the outline in blocks of about equal length.
/// @param at  the piece over t = 0..1; its first point is there already
template <class At>
void piece(NcText& nc, const At& at) {
  double length = 0.0;
  constexpr int kMeasure = 200;
  for (int i = 1; i <= kMeasure; ++i) {
    length += (at(1.0 * i / kMeasure) - at(1.0 * (i - 1) / kMeasure)).norm();
  }
  const int blocks = std::max(1, static_cast<int>(std::lround(length / kBlock)));
  for (int i = 1; i <= blocks; ++i) {
    nc.line_to(at(1.0 * i / blocks));
  }
}

/// One side of a tooth from the root circle to its tip, or from there down.
///
///   tip   ---.        sharp
///             \.      involute
///   base       |      radial
///   root     __)      fillet
///
/// @param side  -1 before the tooth's middle, upward; 1 behind it, downward
void flank(NcText& nc, double middle, double side) {
  const double base = kPitch * std::cos(kPressureAngle);
  const double low = middle + side * half_tooth(base, base);  // of the radial part
  const double turn = side * std::asin(kFillet / (kRoot + kFillet));
  const Point2 centre = polar(kRoot + kFillet, low + turn);
  const double height = std::sqrt((kRoot + kFillet) * (kRoot + kFillet) - kFillet * kFillet);
  const double from =
      low + turn + std::numbers::pi;  // direction from the fillet's centre to the root circle
  const double sweep = side * (0.5 * std::numbers::pi - std::abs(turn));
  const auto fillet = [&](double t) { return Point2(centre + polar(kFillet, from + t * sweep)); };
  const auto radial = [&](double t) { return polar(height + t * (base - height), low); };
  const auto curve = [&](double t) {
    const double r = base + t * (kTip - base);  // length (r^2 - r_b^2) / (2 r_b): nearly even
    return polar(r, middle + side * half_tooth(base, r));
  };
  if (side < 0.0) {
    piece(nc, fillet);
    piece(nc, radial);
    piece(nc, curve);
  } else {
    piece(nc, [&](double t) { return curve(1.0 - t); });
    piece(nc, [&](double t) { return radial(1.0 - t); });
    piece(nc, [&](double t) { return fillet(1.0 - t); });
  }
}

}  // namespace

ProgramFile gear_program() {
  NcText nc;
  nc.comment(
      "gear: 12 teeth of module 4 mm, involute flanks, roots of radius 1 mm, sharp tips; 0.2 mm");
  nc.comment("made by twin_generate_programs, see README.md; starts at X0 Y0 Z0");
  nc.start_of_program(3000.0);
  const double base = kPitch * std::cos(kPressureAngle);
  const double foot = half_tooth(base, base) + std::asin(kFillet / (kRoot + kFillet));
  const double tip = half_tooth(base, kTip);
  nc.line_to(polar(kRoot, -foot));
  for (int i = 0; i < kTeeth; ++i) {
    const double middle = 2.0 * std::numbers::pi * i / kTeeth;
    const auto arc = [](double r, double from, double to) {
      return [=](double t) { return polar(r, from + t * (to - from)); };
    };
    flank(nc, middle, -1.0);
    piece(nc, arc(kTip, middle - tip, middle + tip));
    flank(nc, middle, 1.0);
    piece(nc, arc(kRoot, middle + foot, middle + 2.0 * std::numbers::pi / kTeeth - foot));
  }
  nc.line_to(Point2::Zero());
  return {"gear.nc", nc.end_of_program()};
}

}  // namespace twin::programs
