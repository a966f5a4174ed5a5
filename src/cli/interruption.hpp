#pragma once

#include <atomic>

/// How SIGINT, SIGTERM and SIGHUP end the program.
///
///   first signal   sets the flag. What looks at it ends by itself: a machine brakes on the path and
///                  what was recorded is kept, a search hands out the best so far. Whatever has not
///                  ended a moment later is cut off, but for what must finish (see MustFinish).
///                  Files that have no final name yet are removed, and children die with the
///                  program.
///   second signal  ends the program at once, after the outputs of a rig are made safe and the
///                  terminal is put back.
///
/// So each command ends within 0.2 s, or with the machine's standstill.
namespace twin::cli {

/// Begins to watch for signals, with a thread of its own. To be called once. A SIGHUP that the
/// caller's environment ignores, as under nohup, stays ignored.
void watch_signals();

/// Set when the user wants to end.
const std::atomic<bool>& stop_flag() noexcept;

/// Says that the command has ended, so that it is not cut off any more. If it is being cut off
/// already, this does not return.
void keep_from_being_cut_off();

}  // namespace twin::cli
