#pragma once

#include <numbers>

/// Conversions between the base units (mm, s, rad, kg, N, N.m, A, V) and what people, files and
/// MuJoCo use.
///
/// They are called at the edges only: where G-code is read, where text is written, where MuJoCo's
/// metres begin.
namespace twin::units {

inline constexpr double kMmPerInch = 25.4;

constexpr double mm_per_s_from_mm_per_min(double mm_per_min) { return mm_per_min / 60.0; }
constexpr double mm_per_min_from_mm_per_s(double mm_per_s) { return mm_per_s * 60.0; }
constexpr double um_from_mm(double mm) { return mm * 1000.0; }
constexpr double mm_from_um(double um) { return um / 1000.0; }
constexpr double m_from_mm(double mm) { return mm / 1000.0; }
constexpr double mm_from_m(double m) { return m * 1000.0; }
constexpr double s_from_ms(double ms) { return ms / 1000.0; }
constexpr double rad_from_deg(double deg) { return deg * std::numbers::pi / 180.0; }
constexpr double deg_from_rad(double rad) { return rad * 180.0 / std::numbers::pi; }

}  // namespace twin::units
