#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"

namespace twin {

/// Lengths, counts and times of a planned program. plan() makes it.
///
///     const twin::Plan plan = twin::plan(twin::Program::from_file("square.nc"), twin::Settings());
///     std::printf("%.3f s for %.1f mm\n", plan.time(), plan.path_length());
///
/// The planner turns the blocks of the program into segments: lines, arcs and curves. One curve may
/// take the place of many short blocks.
class TWIN_EXPORT Plan {
 public:
  double time() const noexcept { return time_; }                ///< planned time of motion [s]
  double path_length() const noexcept { return path_length_; }  ///< length of all segments [mm]
  std::int64_t blocks() const noexcept { return blocks_; }      ///< blocks of the program that move
  std::int64_t curves() const noexcept { return curves_; }      ///< segments that are curves
  std::int64_t lines() const noexcept { return lines_; }        ///< segments that are lines
  std::int64_t arcs() const noexcept { return arcs_; }          ///< segments that are arcs
  std::int64_t segments() const noexcept { return curves_ + lines_ + arcs_; }

  /// Upper bound of the deviation between planned and programmed path: no place of either one is
  /// farther than this from the other [mm]. Nothing with planning.planner = paper, which gives no
  /// such guarantee.
  std::optional<double> certified_deviation() const noexcept { return certified_deviation_; }

  /// Lower bound of the time for this path: the time-optimal motion with the same limits of
  /// feedrate and acceleration, but without a limit of jerk [s]. Plans the program once more, and
  /// so takes longer than plan() did.
  /// @param stop  ends the work early when it is set by another thread; may be null
  /// @throws Failure if the program cannot be read again, or kInterrupted
  double bound(const std::atomic<bool>* stop = nullptr) const;

 private:
  friend struct Inside;
  Plan(Program program, Settings settings)
      : program_(std::move(program)), settings_(std::move(settings)) {}

  Program program_;
  Settings settings_;
  double time_ = 0.0;
  double path_length_ = 0.0;
  std::int64_t blocks_ = 0;
  std::int64_t curves_ = 0;
  std::int64_t lines_ = 0;
  std::int64_t arcs_ = 0;
  std::optional<double> certified_deviation_;
};

/// Plans a whole program; nothing moves.
/// @param stop  ends the work early when it is set by another thread; may be null
/// @throws Failure if the program has an error or leaves the travel of the machine, or kInterrupted
TWIN_EXPORT Plan plan(const Program& program, const Settings& settings,
                      const std::atomic<bool>* stop = nullptr);

}  // namespace twin
