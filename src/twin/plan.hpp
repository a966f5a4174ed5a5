#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "twin/export.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"

namespace twin {

/// What planning made of a program: lengths, counts and the time that the motion will take.
class TWIN_EXPORT Plan {
 public:
  double time() const noexcept { return time_; }                ///< planned time of motion [s]
  double path_length() const noexcept { return path_length_; }  ///< along the segments [mm]
  std::int64_t blocks() const noexcept { return blocks_; }      ///< of the program, that move
  std::int64_t curves() const noexcept { return curves_; }      ///< segments that are curves
  std::int64_t lines() const noexcept { return lines_; }        ///< segments that are lines
  std::int64_t arcs() const noexcept { return arcs_; }          ///< segments that are arcs
  std::int64_t segments() const noexcept { return curves_ + lines_ + arcs_; }

  /// Bound of the path's distance from the program, both ways [mm]; nothing where the planner
  /// certifies none.
  std::optional<double> certified_deviation() const noexcept { return certified_deviation_; }

  /// Lower bound of the time of this path: what it would take without limit of jerk [s]. Plans the
  /// program once more.
  double bound() const;

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

/// Plans a whole program. @throws Failure if the program is wrong or leaves the machine's travel
TWIN_EXPORT Plan plan(const Program& program, const Settings& settings);

}  // namespace twin
