#pragma once

#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "runtime/override_schedule.hpp"
#include "tests/fuzz/chain/byte_source.hpp"
#include "tests/fuzz/chain/program_builder.hpp"
#include "tests/fuzz/chain/stop_time.hpp"

namespace twin::fuzz {

/// Everything that a run of the whole chain is made of: settings, program, and what an operator
/// does meanwhile.
struct Case {
  config::MachineFile machine;
  MadeProgram program;
  std::vector<runtime::OverrideChange> operations;  ///< ascending in time; 0 % holds
  std::vector<std::size_t> cuts;  ///< where in the bytes operations begin, then each stretch
  double reference_time = 0.0;    ///< of a motion that stops after each block, rests included [s]
};

/// Settings that the bytes ask for: both planners, limits from a hundredth of the usual ones to a
/// thousand million, all periods, look-ahead from the least on, tolerances, limits of single axes.
config::MachineFile make_settings(ByteSource& bytes);

/// Time of one block from rest to rest, or of the rest that it is [s].
double reference_time(const Piece& piece, const config::MachineFile& machine);

/// A program that the bytes ask for: lines, arcs, helices, NURBS, dwells, smooth runs, crumbs,
/// zigzags and reversals, with modes and units in between. It takes some thousand periods at most,
/// whatever the limits, for every block is cut to a length that fits.
MadeProgram make_program(ByteSource& bytes, const config::MachineFile& machine);

/// Settings, operations and a program from bytes.
Case make_case(Bytes bytes);

/// The case as an NC program, with the command line that runs it in a comment.
std::string show(const Case& made);

}  // namespace twin::fuzz
