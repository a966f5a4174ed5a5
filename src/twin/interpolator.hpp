#pragma once

#include <memory>
#include <optional>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/set_point.hpp"
#include "twin/settings.hpp"

namespace twin {

/// Computes the set points of a program, one for each interpolation period, for a control loop of
/// the caller's own. No machine moves, and no file is written.
///
///     twin::Interpolator interpolator(twin::Program::from_file("square.nc"), twin::Settings());
///     while (const auto point = interpolator.next()) {
///       follow(point->position, point->velocity);  // [mm], [mm/s]
///     }
///
/// next() plans as much of the path as the look-ahead needs. So some calls take longer than a
/// period and allocate memory. A loop in hard real time should take its set points from a buffer
/// that another thread fills ahead of time.
///
/// The travel of the machine is not checked; Program::check() does that.
///
/// Only one thread at a time may call next(). The other functions may be called from any thread.
class TWIN_EXPORT Interpolator {
 public:
  /// Opens the program and copies the settings. Nothing is planned yet.
  /// @throws Failure if the program cannot be opened
  Interpolator(const Program& program, const Settings& settings);
  Interpolator(Interpolator&&) noexcept;
  Interpolator& operator=(Interpolator&&) noexcept;
  ~Interpolator();

  /// Returns the set point of the next period. The first one is the start of the path, at rest.
  ///
  /// @returns nothing once the last set point, at rest at the end of the path, has been returned
  /// @throws Failure if the program has an error. The motion brakes before the error: the set
  ///         points returned until then lie on the path and end at rest.
  std::optional<SetPoint> next();

  double period() const noexcept;  ///< time from one set point to the next [s]

  /// Sets the feed override. It takes effect a little farther along the path, where the feedrate
  /// can be changed without a step of the acceleration.
  /// @param percent  share of the programmed feedrate, 0 to 200; 0 acts like hold() [%]
  void set_override(double percent);
  /// Feed hold: brakes to rest on the path. From then on next() returns the place of rest, period
  /// after period, until resume() is called.
  void hold();
  /// Ends the feed hold: the motion goes on from the place of rest.
  void resume();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace twin
