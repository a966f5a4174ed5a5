#pragma once

#include <memory>

#include "cli/arguments.hpp"
#include "core/error.hpp"
#include "session/session.hpp"
#include "shadow/live_shadow.hpp"

namespace twin::cli {

/// The shadow of `twin run --shadow`: it watches while the machine moves, and leaves shadow.json and a
/// line in the history. Without --shadow it does nothing.
class ShadowedRun {
 public:
  /// Reads what was learnt, or takes the model's own runs, and adds the shadow to the session.
  static Expected<ShadowedRun> open(const ShadowArguments& arguments, Verbosity verbosity,
                                    session::Session& session);

  /// Writes what it saw, also of a run that ended early.
  Expected<void> finish(const session::Session& session) const;

 private:
  ShadowArguments arguments_;
  Verbosity verbosity_ = Verbosity::kNormal;
  std::unique_ptr<shadow::LiveShadow> shadow_;
};

/// The history of a machine's runs: beside the file of what was learnt, or in a folder where there is
/// none.
std::filesystem::path history_of(const std::filesystem::path& learnt,
                                 const std::filesystem::path& folder);

/// The time now, as "2026-11-28T07:10:00Z".
std::string utc_now();

}  // namespace twin::cli
