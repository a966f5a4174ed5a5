#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "gcode/program_text.hpp"

namespace twin::gcode {

/// The lines of a program, one at a time, in constant memory.
///
/// Lines end in LF, CR LF or CR; the last one may lack its end. A UTF-8 byte order mark is skipped,
/// and so are control characters other than NUL in front of a line, which a transfer over a serial
/// line and DOS put there.
///
///   buffer   |<-- given out -->|<------ unread ------>|
///            0               begin_                  end_
/// Before a line is looked for, the buffer holds a whole line of the largest length or the rest of
/// the program, so a line is never in two pieces.
class LineSource {
 public:
  static constexpr std::size_t kLongestLine = 4096;  ///< longer lines are refused [bytes]

  /// Where a line begins.
  struct Place {
    std::int64_t offset = 0;  ///< [bytes]
    std::int64_t line = 0;    ///< lines before it
  };

  explicit LineSource(ProgramText program);

  /// Where the next line begins.
  Place place() const noexcept { return {bytes_, line_}; }

  /// Goes to a place that place() gave: next() gives its line. Places near by cost nothing.
  void seek(const Place& place) noexcept;

  /// The next line without its end, or nullopt after the last; valid until the next call.
  ///
  /// Fails on a line longer than kLongestLine and when the program's copy cannot be read on.
  Expected<std::optional<std::string_view>> next();

  /// Control characters that were left out in front of the last line given.
  std::size_t stepped_over() const noexcept { return stepped_over_; }

  std::int64_t line() const noexcept { return line_; }  ///< number of the last line given, from 1
  std::int64_t bytes_read() const noexcept { return bytes_; }     ///< bytes given out so far
  std::int64_t size() const noexcept { return program_.size(); }  ///< bytes in all

 private:
  Expected<void> refill();

  ProgramText program_;
  std::int64_t taken_ = 0;  // bytes of the program that went to the buffer
  std::string buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::int64_t line_ = 0;
  std::int64_t bytes_ = 0;
  std::size_t stepped_over_ = 0;
};

}  // namespace twin::gcode
