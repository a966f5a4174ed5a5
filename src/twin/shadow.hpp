#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "twin/export.hpp"
#include "twin/settings.hpp"

namespace twin {

/// A change of a machine that its shadow has seen.
struct ShadowFinding {
  std::string axis;   ///< "x" or "y"
  std::string cause;  ///< "friction", "vref_gain", "loop_gain", "encoder", "backlash", ...
  /// Of the parameter against the healthy machine. Relative for friction, vref_gain, loop_gain,
  /// stiffness (of the compliance), motor_force and encoder (share of the counts that pass); of offset
  /// in V, inertia in kg, force in N, backlash in mm.
  double change = 0.0;
  double deviation = 0.0;              ///< standard deviation of the change, in the same unit
  double since = 0.0;                  ///< time at which it began [s]
  double found = 0.0;                  ///< time at which it was named [s]
  std::vector<std::string> or_else{};  ///< causes that cannot be told from it
  std::string text;                    ///< all of it in words, a line
};

/// What a shadow saw of a run.
struct ShadowReport {
  std::string trace;                      ///< file of the run; empty for one that was watched live
  std::vector<ShadowFinding> findings{};  ///< at most one an axis
  std::string switched_off;               ///< why it ended early; empty: it watched to the end
  std::string table;                      ///< what `twin shadow` prints
  std::string json;                       ///< the text of shadow.json
};

/// Learns what healthy runs of a machine are like, and writes it to a file that watch() and
/// RunOptions::shadow take.
///
/// @param traces   CSV or HDF5 files of runs, or recordings of any machine
/// @param columns  which columns are which signal, as IdentifyOptions::columns has it
/// @param stop     ends it with a Failure once it is set; may be null
/// @returns what `twin shadow --learn` prints
/// @throws Failure if a trace cannot be read, if the motion is too short to learn from, or if the
///         table was never identified
TWIN_EXPORT std::string learn_shadow(const std::vector<std::string>& traces,
                                     const Settings& settings, const std::string& file,
                                     const std::string& columns = "",
                                     const std::atomic<bool>* stop = nullptr);

/// Lets the identified model run beside recorded runs and says what has changed of the machine.
///
/// @param learnt  file of learn_shadow(); empty: only the model and its uncertainty are known
/// @param stop    ends it with a Failure once it is set; may be null
/// @returns a report for each recording, in order
/// @throws Failure if a trace cannot be read, or if the file was learnt of another machine, other
///         signals or another period
TWIN_EXPORT std::vector<ShadowReport> watch(const std::vector<std::string>& traces,
                                            const Settings& settings,
                                            const std::string& learnt = "",
                                            const std::string& columns = "",
                                            const std::atomic<bool>* stop = nullptr);

}  // namespace twin
