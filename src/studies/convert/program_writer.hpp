#pragma once

#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {

/// Writes an NC program in a dialect, block by block; modal words once, coordinates absolute.
class ProgramWriter {
 public:
  /// @param start  position before the first block [mm]
  ProgramWriter(const Dialect& dialect, const Vec3& start);

  void comment(std::string_view text);
  void begin();
  void end() { text_ += "M30\n"; }

  /// Writes a line, arc or rest. Returns how many blocks it is for a reader: 0 where its length is
  /// lost in the rounding of the coordinates.
  std::int64_t write(const gcode::Block& block);

  /// Writes a curve that begins where the tool is, with the demands of a block.
  Expected<CurveCounts> write_curve(const CurveRequest& request, const gcode::Block& demands);

  const std::string& text() const noexcept { return text_; }
  std::int64_t lines() const noexcept;

 private:
  void set_mode(const gcode::Block& block);
  std::string feed_word(const gcode::Block& block);
  std::string axis_words(const Vec3& end);
  void write_move(const std::string& word, const std::string& words, const gcode::Block& block);
  std::int64_t write_arc(const gcode::Block& block);
  Vec3 in_file(const Vec3& place) const;

  const Dialect& dialect_;
  std::string text_;
  std::string motion_;  // G word of motion in force
  std::string mode_;    // line of the path mode in force
  std::string feed_;    // F word in force
  std::string plane_ = "G17";
  Vec3 position_;  // as in the file [mm]
};

}  // namespace twin::studies::convert
