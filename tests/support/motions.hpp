#pragma once

#include <cmath>
#include <numbers>

/// Smooth plane motions in closed form, for driving a machine in tests.
namespace twin::test {

/// A quantity with its first and second time derivative.
struct Motion1 {
  double value = 0.0;
  double rate = 0.0;
  double rate2 = 0.0;
};

/// Distance along a path that starts at rest at t = 0 and blends into constant speed.
///
/// Speed V (6 b^5 - 15 b^4 + 10 b^3) with b = t / ramp up to the ramp's end, V afterwards;
/// acceleration and jerk are continuous.
inline Motion1 smooth_start(double t, double speed, double ramp) {
  if (t <= 0.0) {
    return {};
  }
  if (t >= ramp) {
    return {speed * (t - 0.5 * ramp), speed, 0.0};
  }
  const double b = t / ramp;
  const double b3 = b * b * b;
  return {speed * ramp * b3 * b * (b * b - 3.0 * b + 2.5),
          speed * b3 * (6.0 * b * b - 15.0 * b + 10.0),
          speed / ramp * 30.0 * b * b * (b - 1.0) * (b - 1.0)};
}

/// Set point in the plane [mm, mm/s, mm/s^2].
struct PlanePoint {
  double position[2] = {0.0, 0.0};
  double velocity[2] = {0.0, 0.0};
  double acceleration[2] = {0.0, 0.0};
};

/// Circle through the origin at phase 0, counter-clockwise, centre (-radius, 0). @param s distance
/// along it [mm]
inline PlanePoint on_circle(double radius, const Motion1& s) {
  const double angle = s.value / radius;
  const double c = std::cos(angle);
  const double si = std::sin(angle);
  PlanePoint p;
  p.position[0] = radius * (c - 1.0);
  p.position[1] = radius * si;
  p.velocity[0] = -si * s.rate;
  p.velocity[1] = c * s.rate;
  p.acceleration[0] = -si * s.rate2 - c * s.rate * s.rate / radius;
  p.acceleration[1] = c * s.rate2 - si * s.rate * s.rate / radius;
  return p;
}

}  // namespace twin::test
