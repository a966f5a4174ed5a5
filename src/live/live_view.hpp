#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "twin/trace.hpp"

/// A run is looked at while it goes on.
namespace twin::live {

/// What a live page says of its run.
struct LiveRun {
  gcode::ProgramText program;
  config::MachineFile machine;
  std::string hal;        ///< name of the machine
  bool simulated = true;  ///< false if real axes move
};

/// Serves the page of a run on the loopback address while the run goes on, and sends it the rows.
///
///   GET /TOKEN/         the page, as report.html, without rows
///   GET /TOKEN/events   server-sent events: rows as JSON arrays; `end` when the run has ended
///
/// The token is a random number, so that no other user of this computer sees the run. Everything
/// else is answered with 404. Browsers may come and go: who comes late gets all rows. Of the rows at
/// most kRowsPerSecond are kept, so that memory grows with time slowly (36 MB an hour).
///
/// The rows come from the recorder; neither motion nor recorder waits for a browser.
class LiveView : public TraceSink {
 public:
  static constexpr double kRowsPerSecond = 100.0;

  /// "http://127.0.0.1:PORT/TOKEN/"
  virtual const std::string& address() const noexcept = 0;
};

/// Starts to serve. The server is a module that is loaded only now, since the library that it needs
/// takes as long to load as all the rest of the program.
///
/// @param port  0: any that is free
/// @returns an error if the port is in use
Expected<std::unique_ptr<LiveView>> open_live_view(const LiveRun& run, int port);

}  // namespace twin::live
