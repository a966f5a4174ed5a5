#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/notes.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

/// Reads an NC program block by block, in constant memory.
///
///   ProgramText --Flow--> line --Lexer, LineWords--> words --Interpreter--> Block
///
/// Flow follows loops, branches and calls; LineWords has the values of words computed by
/// Parameters; Interpreter holds the modal state. What each understands is told there. Letters are
/// upper or lower case, with or without blanks between words. G17 G21 G90 G94 G64 are in force at
/// the start, and no motion word is. Anything not known is an error with line and column; what
/// has no effect here is a note.
///
/// A block starts at the end of the block before it, bit for bit. A move of no length makes no
/// block.
class Reader {
 public:
  explicit Reader(const ProgramText& program, const ReaderOptions& options = {});
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader();

  /// Reads the program in a file (see ProgramText::read()) for this reading alone.
  static Expected<Reader> open(const std::string& path, const ReaderOptions& options = {});

  /// A program held in memory; name takes the place of the path in messages.
  static Reader from_text(std::string text, std::string name, const ReaderOptions& options = {});

  /// The next block, or nullopt at the end of the program.
  ///
  /// A program without any move is an error, reported at its end. After an error every call returns
  /// it.
  Expected<std::optional<Block>> next();

  /// After an error: leaves out the line that has it, so that next() reads on behind it.
  /// @returns false where that makes no sense: the text cannot be read on
  bool resume();

  /// Notes on what has been read so far.
  const Notes& notes() const noexcept;

  /// Number of the last line read, from 1; 0 before the first.
  std::int64_t line() const noexcept;

  /// Bytes of the program read so far.
  std::int64_t bytes_read() const noexcept;

  /// Bytes of the whole program.
  std::int64_t size() const noexcept;

 private:
  class Reading;
  std::unique_ptr<Reading> reading_;
};

}  // namespace twin::gcode
