#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/program_settings.hpp"
#include "core/vec.hpp"

namespace twin::gcode {

class ToolTable;

/// How a program is read: what is not in its text.
struct ReaderOptions {
  Vec3 start{0.0, 0.0, 0.0};  ///< position before the first block [mm]
  bool lifts_start = false;   ///< begin above that position as start_of() says
  /// Feedrate in place of the program's F words, which may then be missing [mm/s].
  std::optional<double> feedrate{};
  /// Whether probing moves go their whole way; else they are refused: a machine would not stop.
  bool may_probe = true;
  bool block_delete = true;       ///< skip lines that begin with '/'
  Vec3 workpiece{0.0, 0.0, 0.0};  ///< where the origin of the program's coordinates lies [mm]
  std::shared_ptr<const ToolTable> tools{};  ///< may be null: that of the file below
  std::string tool_table{};                  ///< file; empty: no tool has a length or a diameter
  /// The parts of a reading, Interpreter among them, never see kAuto.
  Dialect dialect = Dialect::kAuto;
  /// Whether the first arc whose end tells decides how I J K are meant, until G90.1 or G91.1.
  bool guesses_centres = false;
  std::string ignored_axes{};               ///< of "ABCEUVW": words that are left out and counted
  double default_feedrate = 0.0;            ///< for feed moves without an F; 0: none [mm/s]
  std::string parameters{};                 ///< values of parameters, as "#100 = 5, _hal[a] = 1"
  double largest_feedrate = 0.0;            ///< above it an F is noted; 0: none is [mm/s]
  std::int64_t most_lines = 20'000'000;     ///< executed again by loops and calls before it ends
  const std::atomic<bool>* stop = nullptr;  ///< ends a reading with kInterrupted; may be null
};

}  // namespace twin::gcode
