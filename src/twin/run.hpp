#pragma once

#include <atomic>
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
#include "twin/servo.hpp"
#include "twin/settings.hpp"
#include "twin/shadow.hpp"
#include "twin/summary.hpp"
#include "twin/trace.hpp"

namespace twin {

/// The operator's panel of a run: it takes feed override, feed hold and stop while the machine
/// moves, and shows what the motion is doing.
///
/// Give its address to run() in RunOptions::panel and use it from another thread. Every function
/// may be called from every thread at any time, and none waits.
class TWIN_EXPORT Panel {
 public:
  /// What a motion is doing.
  enum class State : std::uint8_t {
    kWaiting,  ///< has not begun
    kMoving,   ///< follows the path
    kHolding,  ///< brakes for a feed hold, or is at rest in it
    kStarved,  ///< at rest until enough of the path is planned
    kEnded,    ///< has come to its end, for whatever reason
  };
  /// The state of the motion. Its values are from the last few periods, not all from the same one.
  struct Display {
    State state = State::kWaiting;
    double time = 0.0;       ///< time since the first set point [s]
    double percent = 100.0;  ///< feed override of the plan that is followed [%]
    double feedrate = 0.0;   ///< speed along the path [mm/s]
    std::int64_t line = 0;   ///< line of the NC program
  };

  Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
  ~Panel();

  /// Sets the feed override. It takes effect where the feedrate can be changed without a step of
  /// the acceleration.
  /// @param percent  share of the programmed feedrate, clamped to 0 to 200; 0 acts like hold() [%]
  void set_override(double percent) noexcept;
  void hold() noexcept;    ///< feed hold: brakes to rest on the path; the drives stay on
  void resume() noexcept;  ///< ends the feed hold
  /// Brakes to rest on the path and ends the run. Run::failure then says kInterrupted.
  void stop() noexcept;
  Display display() const noexcept;  ///< what the motion is doing now

 private:
  friend struct Inside;
  struct Data;
  std::unique_ptr<Data> data_;
};

/// A change of the feed override at a given time of the motion.
struct OverrideChange {
  double time = 0.0;       ///< time since the first set point [s]
  double percent = 100.0;  ///< share of the programmed feedrate, 0 to 200; 0 is a feed hold [%]
};

/// Options of a run. All have defaults; with these a run leaves no files and goes as fast as it can
/// be computed.
struct RunOptions {
  /// Sinks that get the rows of the trace. They must outlive the run.
  std::vector<TraceSink*> sinks{};
  /// Folder for trace and summary.json, the files that `twin run` writes. Empty: no files.
  std::string folder{};
  /// Files of the trace in that folder: "csv", "hdf5", "both" or "none".
  std::string trace_files = "csv";
  /// True: each period of the controller takes one period of the wall clock. False: the periods
  /// follow each other as fast as they can be computed. A machine that keeps its own time
  /// (MachineInfo::keeps_own_time) is always run on the wall clock.
  bool is_wall_clock = false;
  /// Changes of the feed override, in ascending order of time.
  std::vector<OverrideChange> overrides{};
  /// Operator's panel, or null. It must outlive the run. In simulated time the motion is not in
  /// step with the thread that uses the panel, so two runs with the same orders may differ.
  Panel* panel = nullptr;
  /// Ends the run when another thread sets it: before the motion at once, then by braking to rest on
  /// the path. Run::failure, or the Failure, says kInterrupted. May be null; a run with a panel has
  /// Panel::stop() instead.
  const std::atomic<bool>* stop = nullptr;
  /// File of compensate() that the run follows. Empty: none.
  std::string correction{};
  /// Folder in which runs are learnt from: the run follows the correction in it, or one that is made
  /// now, and leaves a better one for the next run. A run that ends early is not learnt from. Empty:
  /// nothing is learnt.
  std::string learning{};
  /// Lets the identified table run beside the machine, in a thread of its own; Run::shadow says what
  /// it saw. With a folder of the run it leaves shadow.json there.
  bool has_shadow = false;
  /// File of learn_shadow() that the shadow goes by; empty: only the model and its uncertainty.
  std::string shadow_learnt{};
  /// Position loops in place of those of the settings, or null. They must outlive the run.
  Servo* servo = nullptr;
  /// Called in the thread that called run(), with the share that is done, 0 to 1.
  std::function<void(double)> progress{};
};

/// How a run went.
struct Run {
  Summary summary;                       ///< summary of everything that was recorded
  std::optional<Error> failure;          ///< why the run ended early; nothing if it reached the end
  std::optional<ShadowReport> shadow{};  ///< what the shadow saw, if there was one
};

/// Plans a program, moves the machine along it, and records every period.
///
///     const auto table = twin::make_table(settings);
///     twin::MemoryTrace trace;
///     const twin::Run run = twin::run(program, settings, *table, {.sinks = {&trace}});
///
/// Before anything moves, the whole program is read, checked against the travel of the machine and
/// planned. However the run ends, the drives are off afterwards. Different machines may run at the
/// same time in different threads. A simulated machine in simulated time gives the same trace, byte
/// for byte, each time.
///
/// @param machine  an unconfigured machine; the run leaves it unconfigured again
/// @returns the summary, and the failure if something ended the run while it was under way
/// @throws Failure if the run cannot begin, in which case nothing has moved, or if summary.json
///         cannot be written after it
TWIN_EXPORT Run run(const Program& program, const Settings& settings, Machine& machine,
                    const RunOptions& options = {});

/// Writes a trace to the file FOLDER/trace.h5, byte for byte as `twin run --trace hdf5` does. The
/// trace of a run that ended early becomes trace.partial.h5.
///
/// @param summary  what Summary::json() gives of the run
/// @throws Failure if the file cannot be written
TWIN_EXPORT void write_hdf5(const MemoryTrace& trace, const Program& program,
                            const Settings& settings, const std::string& summary,
                            const std::string& folder);

}  // namespace twin
