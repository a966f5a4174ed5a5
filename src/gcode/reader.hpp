#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/interpreter.hpp"
#include "gcode/line_source.hpp"
#include "gcode/line_words.hpp"
#include "gcode/program_text.hpp"

namespace twin::gcode {

struct ReaderOptions {
  Vec3 start{0.0, 0.0, 0.0};  ///< position before the first block [mm]
  /// Feedrate in place of the program's F words, which may then be missing [mm/s].
  std::optional<double> feedrate;
  bool block_delete = true;  ///< skip lines that begin with '/'
};

/// Reads an NC program block by block, in constant memory.
///
///   ProgramText -> LineSource -> line -> Lexer -> LineWords -> Interpreter -> Block
///
/// The reader understands
///   G00 to G04, G05.2 G05.3 and G06.2 G06.3 (NURBS, see NurbsCollector), G17 G18 G19, G20 G21,
///   G40, G49, G54, G61 G61.1 G64 P, G80, G90 G91, G94, F S T N, M00 to M09, M30,
/// comments from ( to ) and from ; to the end of the line, the lines with %, and block delete.
/// Letters are upper or lower case, with or without blanks between words. G17 G21 G90 G94 G64 are
/// in force at the start, and no motion word is. Anything else in a program is an error with line
/// and column; nothing is ignored in silence.
///
/// A block starts at the end of the block before it, bit for bit. A move of no length makes no
/// block.
class Reader {
 public:
  explicit Reader(const ProgramText& program, const ReaderOptions& options = {});
  Reader(Reader&&) noexcept = default;
  Reader& operator=(Reader&&) noexcept = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() = default;

  /// Reads the program in a file (see ProgramText::read()) for this reading alone.
  static Expected<Reader> open(const std::string& path, const ReaderOptions& options = {});

  /// A program held in memory; name takes the place of the path in messages.
  static Reader from_text(std::string text, std::string name, const ReaderOptions& options = {});

  /// The next block, or nullopt at the end of the program.
  ///
  /// A program without any move is an error, reported at its end. After an error every call returns
  /// it.
  Expected<std::optional<Block>> next();

  /// Number of the last line read, from 1; 0 before the first.
  std::int64_t line() const noexcept { return source_.line(); }

  /// Bytes of the program read so far.
  std::int64_t bytes_read() const noexcept { return source_.bytes_read(); }

  /// Bytes of the whole program.
  std::int64_t size() const noexcept { return source_.size(); }

 private:
  Expected<void> read_line();
  Expected<void> read_percent_line(std::string_view text, int column);
  Expected<void> finish();
  tl::unexpected<Error> stop_with(Error error);

  LineSource source_;
  std::string name_;
  bool skips_deleted_blocks_;
  LineWords words_;
  Interpreter interpreter_;
  LineBlocks blocks_;            // of the line last read
  std::size_t next_block_ = 0;   // place in blocks_ of the next one to give
  std::int64_t text_lines_ = 0;  // lines read that are not blank
  bool has_percent_ = false;     // the first % line has been read
  bool has_moved_ = false;       // a block other than a dwell was given
  bool is_at_end_ = false;
  std::optional<Error> error_;
};

}  // namespace twin::gcode
