#pragma once

#include <atomic>
#include <filesystem>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "shadow/report.hpp"
#include "shadow/shadow.hpp"

namespace twin::studies::shadow {

/// Lets the identified table run beside a recorded run.
///
/// @param learnt  what healthy runs are like, a file; empty: those of the model, as uncertain as
///                [uncertainty] says
/// @param gives   whether the screws of the model give
/// @param stop    ends it once it is set; may be null
/// @returns what it saw, with `switched_off` where its model did not stay finite; or an error where
///          the file was learnt of another machine, other signals or another period
Expected<twin::shadow::ShadowReport> watch_track(const config::MachineFile& machine,
                                                 const twin::shadow::Track& track,
                                                 const std::filesystem::path& learnt, bool gives,
                                                 const std::atomic<bool>* stop = nullptr);

}  // namespace twin::studies::shadow
