#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "studies/predict/tolerance.hpp"

namespace twin::studies::predict {

/// How fast a program may be cut.
struct FastestOptions {
  double tolerance = 0.015;     ///< of the contour error of the table [mm]
  double share = 0.95;          ///< of the possible machines that keep it
  std::size_t machines = 40;    ///< tried in each step of the search
  std::size_t verifying = 200;  ///< others, tried at the end
  int halvings = 5;             ///< of the interval of feedrates
  int rounds = 10;              ///< of raising and lowering the feedrates of stretches
  std::uint64_t seed = 1;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> tell{};  ///< gets what is being done
};

/// One way to cut a program.
struct CutPlan {
  double time = 0.0;             ///< planned [s]
  double feedrate = 0.0;         ///< in place of the F words; 0: a feedrate for each stretch [mm/s]
  TolerancePrediction verified;  ///< on machines that the search has not seen
};

/// A stretch of blocks that share a feedrate.
struct FeedStretch {
  std::int64_t first_line = 0;  ///< of the program
  std::int64_t last_line = 0;
  double feedrate = 0.0;  ///< [mm/s]
};

/// The fastest ways that keep a tolerance.
struct Fastest {
  std::optional<CutPlan> whole;       ///< one feedrate for the program; none keeps the tolerance
  std::optional<CutPlan> stretches;   ///< a feedrate for each stretch
  std::vector<FeedStretch> schedule;  ///< of `stretches`
  std::string program;                ///< NC text of `stretches`
  std::string why_no_stretches;       ///< what cannot be written with feedrates of its own
  /// The paper's planner, whose servo model (Eqs. 2 to 6) knows no friction: told this tolerance,
  /// and the fastest of its plans that keeps it in fact.
  CutPlan paper_told;
  std::optional<CutPlan> paper;
};

/// Finds how fast a program may be cut.
///
/// A feedrate keeps the tolerance if the largest contour error of cutting motion is within it on a
/// share of possible machines (Uncertainty). One feedrate for the whole program is found by halving
/// intervals. From there the feedrate of each stretch of at least 5 mm goes up where the error of
/// the stretch leaves room, and down for good where it does not; then what lies between the last
/// schedule and the one feedrate is tried. The fastest of these that keeps the tolerance is the
/// result. What the machines of the search keep must hold on as many others, or the
/// next slower one is taken; results are then verified on a third set of machines.
Expected<Fastest> fastest(const gcode::ProgramText& program, const config::MachineFile& machine,
                          const FastestOptions& options);

/// The results as text for the terminal.
std::string to_table(const Fastest& fastest, const FastestOptions& options);

}  // namespace twin::studies::predict
