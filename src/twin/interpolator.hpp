#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"

namespace twin {

/// Reference of one interpolation period.
struct SetPoint {
  double time = 0.0;                     ///< since the first set point [s]
  std::array<double, 3> position{};      ///< x, y, z [mm]
  std::array<double, 3> velocity{};      ///< x, y, z [mm/s]
  std::array<double, 3> acceleration{};  ///< x, y, z [mm/s^2]
  double feedrate = 0.0;                 ///< along the path [mm/s]
  std::int64_t segment = 0;              ///< planned segment, counted from 0
  std::int64_t line = 0;                 ///< NC line
};

/// Set points of a program for a loop of one's own: one a period, when it is asked for.
///
/// Planning happens inside next(), as far ahead as the look-ahead needs, so a call now and then
/// takes longer than a period and allocates memory. For hard real time draw the set points ahead
/// into a buffer. One thread at a time calls next(); the rest may be called from any.
class TWIN_EXPORT Interpolator {
 public:
  /// @throws Failure if the program cannot be opened
  Interpolator(const Program& program, const Settings& settings);
  Interpolator(Interpolator&&) noexcept;
  Interpolator& operator=(Interpolator&&) noexcept;
  ~Interpolator();

  /// The set point of the next period; nothing after the last one, at rest at the path's end.
  /// @throws Failure where the program is wrong; the path until there has been given out
  std::optional<SetPoint> next();

  double period() const noexcept;  ///< time from one set point to the next [s]

  /// Feed override: from a place ahead the path is followed at this share of the programmed
  /// feedrate. @param percent  0 to 200; 0 holds [%]
  void set_override(double percent);
  /// Brakes on the path to rest and stays there: next() then gives the same place each time.
  void hold();
  /// Goes on after hold().
  void resume();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace twin
