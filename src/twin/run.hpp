#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "twin/error.hpp"
#include "twin/export.hpp"
#include "twin/machine.hpp"
#include "twin/program.hpp"
#include "twin/settings.hpp"
#include "twin/summary.hpp"
#include "twin/trace.hpp"

namespace twin {

/// The operator's panel: feed override, feed hold and stop while a run is under way, and what
/// the motion is doing. Every member may be called from every thread at any time; none waits.
class TWIN_EXPORT Panel {
 public:
  /// What a motion is doing.
  enum class State : std::uint8_t {
    kWaiting,  ///< it has not begun
    kMoving,
    kHolding,  ///< braking to a feed hold, or at rest in it
    kStarved,  ///< at rest until enough of the path is planned
    kEnded,
  };
  /// What the motion shows; each figure is true of one of the last few periods.
  struct Display {
    State state = State::kWaiting;
    double time = 0.0;       ///< since the first set point [s]
    double percent = 100.0;  ///< override that the feedrate is planned for [%]
    double feedrate = 0.0;   ///< [mm/s]
    std::int64_t line = 0;   ///< NC line
  };

  Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
  ~Panel();

  /// @param percent  of the programmed feedrate, 0 to 200; 0 holds [%]
  void set_override(double percent) noexcept;
  void hold() noexcept;    ///< brakes on the path to rest; the drives stay on
  void resume() noexcept;  ///< goes on after hold()
  void stop() noexcept;    ///< brakes on the path and ends the run, which then has a failure
  Display display() const noexcept;

 private:
  friend struct Inside;
  struct Data;
  std::unique_ptr<Data> data_;
};

/// A change of the feed override at a time of the motion.
struct OverrideChange {
  double time = 0.0;       ///< since the first set point [s]
  double percent = 100.0;  ///< of the programmed feedrate, 0 to 200; 0 holds [%]
};

/// What belongs to a run beside program, settings and machine. Nothing of it has to be given.
struct RunOptions {
  /// They get the rows of the trace, and outlive the run.
  std::vector<TraceSink*> sinks{};
  /// Folder for the files that `twin run` leaves, trace.csv and summary.json; empty: none.
  std::string folder{};
  /// One period of the controller a period of the wall clock, in place of as fast as it goes. A
  /// machine that keeps its own time is always run like that.
  bool is_wall_clock = false;
  /// Feed override at times of the motion, ascending.
  std::vector<OverrideChange> overrides{};
  /// Outlives the run. In simulated time what it does takes effect when the motion happens to
  /// look; two runs are then the same only without it.
  Panel* panel = nullptr;
  /// Gets the done share, 0 to 1, in the thread that called run().
  std::function<void(double)> progress{};
};

/// How a run went.
struct Run {
  Summary summary;               ///< of everything that was recorded
  std::optional<Error> failure;  ///< why it ended before the end of the program
};

/// Plans a program, moves the machine along it, and records every period.
///
/// Before anything moves the whole program is read, held against the travel and planned. At the end
/// the machine is off, whatever the reason. Runs on different machines may go on in different
/// threads at the same time. A simulated machine in simulated time gives the same bytes each time.
///
/// @param machine  unconfigured, and left so
/// @returns how it went, a failure on the way included
/// @throws Failure where the run could not be begun: nothing has moved
TWIN_EXPORT Run run(const Program& program, const Settings& settings, Machine& machine,
                    const RunOptions& options = {});

}  // namespace twin
