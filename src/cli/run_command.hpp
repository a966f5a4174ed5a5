#pragma once

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "runtime/run.hpp"
#include "session/session.hpp"

namespace twin::cli {

/// What else is done about a run of `twin run`, before it and after it. This one does nothing.
class RunCompanion {
 public:
  RunCompanion() = default;
  RunCompanion(const RunCompanion&) = delete;
  RunCompanion& operator=(const RunCompanion&) = delete;
  virtual ~RunCompanion() = default;

  /// Completes the request before anything moves. An error ends the command.
  virtual Expected<void> prepare(session::Request& /*request*/) { return {}; }

  /// Looks at what was run, which may have ended early.
  virtual Expected<void> finish(const runtime::RunResult& /*result*/) { return {}; }
};

/// Whether a run has a correction, learns or is predicted, which studies do.
bool needs_studies(const RunArguments& arguments);

/// `twin run`: from the arguments to trace, summary and pictures.
Expected<void> run_program(const RunArguments& arguments, const Environment& environment,
                           RunCompanion& companion);

}  // namespace twin::cli
