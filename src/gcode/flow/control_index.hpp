#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "gcode/flow/control_line.hpp"
#include "gcode/program_text.hpp"
#include "gcode/text/line_source.hpp"

namespace twin::gcode {

/// A line of flow control in a text, and the line that belongs to it.
struct ControlEntry {
  LineSource::Place begin;   ///< of the line
  LineSource::Place behind;  ///< of the line after it
  Keyword keyword = Keyword::kName;
  /// if, elseif, else: the next branch or the endif. while, repeat, do, WHILE, DO: the end of the
  /// body; those ends: their begin. sub: its endsub. break, continue: the begin of their loop.
  std::optional<std::size_t> partner;
};

/// All lines of flow control of a text, so that the flow can go to any of them at once.
///
/// Bodies nest: an end belongs to the innermost begin of its label that is open. What has no partner
/// is no error until the flow comes to it.
class ControlIndex {
 public:
  static constexpr std::size_t kMost = 1'000'000;  ///< lines of flow control in one text

  /// Reads a text once. @param skips_deleted  leaves lines with / out
  static Expected<ControlIndex> of(const ProgramText& text, bool skips_deleted);

  const ControlEntry& operator[](std::size_t place) const { return entries_[place]; }
  /// Place of the entry whose line begins at an offset; there is one.
  std::size_t at_offset(std::int64_t offset) const;
  /// The subroutine of a label, by sub.
  std::optional<std::size_t> find_sub(std::string_view label) const;
  /// The subprogram of a number, by O1234 alone.
  std::optional<std::size_t> find_name(std::string_view label) const;
  /// Where the program that a place belongs to begins and ends: between lines with O1234 alone.
  struct Extent {
    LineSource::Place begin;
    std::int64_t end = 0;  ///< offset
  };
  Extent extent_around(std::int64_t offset, std::int64_t size) const;

 private:
  friend class IndexBuilder;
  using Labels = std::map<std::string, std::size_t, std::less<>>;

  std::vector<ControlEntry> entries_;
  Labels subs_;
  Labels names_;
};

}  // namespace twin::gcode
