#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "hal/machine.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"
#include "runtime/run.hpp"
#include "session/machine.hpp"
#include "session/pictures.hpp"
#include "twin/servo.hpp"
#include "twin/trace.hpp"

/// Runs one program on one machine, from the machine file to the pictures. The command line, the
/// studies and other programs use it. Nothing here prints.
namespace twin::session {

/// By which clock a run goes.
enum class Pace {
  kOwn,        ///< simulated time, or the wall clock where the machine keeps its own time
  kWallClock,  ///< the wall clock in any case
};

/// What a run leaves in its folder.
enum class Files {
  kWritten,  ///< trace and summary
  kNone,     ///< nothing: the rows of the trace go to the sinks alone
};

/// What is to be run.
///
/// The machine is `hal`. If `hal` is null, make_machine() makes the machine. If that is empty too,
/// the program is planned and nothing moves.
struct Request {
  gcode::ProgramText program;
  config::MachineFile machine;
  hal::Machine* hal = nullptr;     ///< unconfigured; outlives the session
  MakeMachine make_machine{};      ///< called by Session::open
  std::optional<double> feedrate;  ///< replaces the program's F words [mm/s]
  std::filesystem::path folder;    ///< folder of the results; empty: renders/NAME of the program
  Files files = Files::kWritten;
  std::vector<TraceSink*> sinks{};  ///< get the rows of the trace, besides the files
  /// As which files the trace is written, where files are.
  results::TraceFiles trace = results::TraceFiles::kCsv;
  std::string columns{};   ///< of the trace, as choose_columns() takes them; empty: default
  Servo* servo = nullptr;  ///< position loops in place of the machine file's; may be null
  Pace pace = Pace::kOwn;
  std::vector<runtime::OverrideChange> overrides{};        ///< feed override at times of the motion
  runtime::Until until{};                                  ///< ends the motion early; may be empty
  std::shared_ptr<const motion::Correction> correction{};  ///< of the set points; may be null
  std::string command{};   ///< command line or the caller's own words, for the summary
  bool has_bound = false;  ///< whether the summary gets the lower bound of the time
};

/// Whoever watches or operates a run. All members may stay empty.
struct Attendance {
  const std::atomic<bool>* stop = nullptr;  ///< the caller sets it to brake on the path and end
  runtime::OperatorPanel* panel = nullptr;  ///< for override and hold by an operator
  std::function<void(double)> progress{};   ///< called with the share that is done, 0 to 1
  std::function<void(double)>
      estimated{};  ///< called with the machining time before the motion [s]
  /// Called with the notes on the program before the motion, if there are any.
  std::function<void(const std::vector<gcode::Note>&)> noted{};
};

/// A program and its machine, ready to run.
///
///   open()           makes the machine
///   run()            plans, moves, writes trace and summary.json
///   draw_figures()   draws the plots of the trace
///   write_report()   writes report.html, the page of the run
///   render_video()   renders video.mp4 from the trace
class Session {
 public:
  static Expected<Session> open(Request request);

  /// File of the program, or the name of its text.
  const std::filesystem::path& program() const noexcept { return request_.program.file(); }
  const gcode::ProgramText& text() const noexcept { return request_.program; }
  const config::MachineFile& machine() const noexcept { return request_.machine; }
  const std::filesystem::path& folder() const noexcept { return request_.folder; }
  /// The machine that moves; null for a plan.
  hal::Machine* hal() const noexcept { return hal_; }
  /// Whether each period of the cycle takes a period of the wall clock.
  bool is_on_wall_clock() const noexcept;
  /// The trace that run() has left, if it was to leave one; of two files the CSV.
  std::filesystem::path trace_file() const;
  /// Title of the pictures: "dolphin.nc, 3000 mm/min".
  std::string title() const;

  /// Lets run() hand the rows to a further sink, which outlives it.
  void add_sink(TraceSink& sink) { request_.sinks.push_back(&sink); }

  /// Runs the program, computes the bound of its time if asked for, and writes the summary. After a
  /// complete run it removes files of earlier runs that the new ones do not replace.
  ///
  /// @returns what was recorded, with `failure` if the run ended early; or an error if the run
  ///          could not begin or its files could not be written
  Expected<runtime::RunResult> run(const Attendance& attendance = {});

  /// Draws the figures of the trace that run() has left, also of a run that ended early.
  Expected<void> draw_figures(pictures::Paper paper = pictures::Paper::kNone) const;

  /// Writes report.html from what run() has left, also of a run that ended early.
  Expected<void> write_report() const;

  /// Renders the video of the trace that run() has left.
  ///
  /// @param camera    camera of the scene: "iso", "top" or "follow"
  /// @param progress  gets the done share, 0 to 1; may be empty
  Expected<void> render_video(const std::string& camera = "iso",
                              std::function<void(double)> progress = {}) const;

 private:
  Session(Request request, std::unique_ptr<hal::Machine> made);

  Request request_;
  std::unique_ptr<hal::Machine> made_;
  hal::Machine* hal_;
  bool is_partial_ = false;  // run() ended early
};

}  // namespace twin::session
