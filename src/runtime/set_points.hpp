#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "motion/interpolator/set_point.hpp"
#include "runtime/feed_control.hpp"
#include "runtime/inline_planning.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/program_planner.hpp"

namespace twin::runtime {

/// The set points of a program, one a period, for a control loop of the caller's own: no machine,
/// no thread, no file.
///
/// It plans whenever it needs more of the path, so next() takes as long as planning does; it is not
/// real-time safe.
class SetPoints {
 public:
  /// @param feedrate  replaces the program's F words [mm/s]
  static std::unique_ptr<SetPoints> open(const gcode::ProgramText& program,
                                         const config::MachineFile& machine,
                                         const std::optional<double>& feedrate = {});
  SetPoints(const SetPoints&) = delete;
  SetPoints& operator=(const SetPoints&) = delete;
  ~SetPoints() = default;

  /// The set point of the next period; the first one is at rest where the path begins. In a feed
  /// hold it stays where it came to rest.
  /// @returns false after the last one, or when the rest of the program cannot be planned: error()
  bool next(motion::SetPoint& out);

  /// Feed override, 0 to 200; 0 holds [%]. Takes effect as soon as the limits allow; any thread may
  /// call it.
  void set_override(double percent) noexcept { panel_.set_override(percent); }
  /// Feed hold: brakes on the path, and goes on when it ends. Any thread may call it.
  void hold(bool is_held) noexcept { panel_.hold(is_held); }

  /// Time of the next set point, since the first one [s].
  double time() const noexcept { return static_cast<double>(periods_) * machine_.period; }
  /// Why planning failed: the motion has braked on the path by then.
  const std::optional<Error>& error() const noexcept { return planning_.error(); }
  /// Shortest way to rest from here [mm].
  double braking_distance() const noexcept { return interpolator_.braking_distance(ramp_); }
  /// The changes of the override that have taken effect.
  const std::vector<results::OverrideRecord>& overrides() const noexcept { return feed_.records(); }

 private:
  SetPoints(gcode::Reader&& reader, const config::MachineFile& machine);

  config::MachineFile machine_;
  gcode::Reader reader_;
  feedrate::RampLimits ramp_;
  ProgramPlanner planner_;
  InlinePlanning planning_;
  motion::Interpolator interpolator_;
  OperatorPanel panel_;
  FeedControl feed_;
  motion::SetPoint last_;
  std::int64_t periods_ = 0;
};

}  // namespace twin::runtime
