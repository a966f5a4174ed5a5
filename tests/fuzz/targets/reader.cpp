#include <cmath>

#include "gcode/reader.hpp"
#include "gcode/start.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace reader_target {

constexpr std::int64_t kMostLines = 2000;  // that loops may execute again
constexpr int kMostErrors = 100;

bool is_sound(const gcode::Block& block) {
  const bool is_arc = block.motion == gcode::Motion::kArc;
  const bool is_nurbs = block.motion == gcode::Motion::kNurbs;
  const bool is_feed = is_arc || is_nurbs || block.motion == gcode::Motion::kLinear;
  const geometry::Arc& arc = block.arc;
  const bool is_round = arc.centre.allFinite() && arc.e1.allFinite() && arc.e2.allFinite() &&
                        arc.radius > 0.0 && arc.sweep > 0.0 && arc.sweep < 6.2832 * 1e4;
  return block.start.allFinite() && block.end.allFinite() && std::isfinite(block.feedrate) &&
         is_feed == (block.feedrate > 0.0) && block.tolerance >= 0.0 && block.dwell >= 0.0 &&
         block.line > 0 && is_nurbs == (block.nurbs != nullptr) && (!is_arc || is_round);
}

/// Behind an error a reading goes on, and its blocks are sound.
void read_on(gcode::Reader& reader) {
  for (int errors = 0; errors < kMostErrors && reader.resume(); ++errors) {
    auto block = reader.next();
    for (; block && *block; block = reader.next()) {
      promise(is_sound(**block), "a block behind an error is not sound");
    }
    if (block) {
      return;
    }
  }
}

/// Blocks are sound and joined, there are no more than the text can hold, and an error stays.
void run(Bytes bytes) {
  gcode::ReaderOptions options;
  options.most_lines = kMostLines;
  options.lifts_start = bytes.size() % 2 == 1;
  options.default_feedrate = bytes.size() % 3 == 0 ? 10.0 : 0.0;
  gcode::Reader reader = gcode::Reader::from_text(std::string(text_of(bytes)), "fuzz.nc", options);
  Vec3 position = gcode::start_of(
      gcode::ProgramText::from_text(std::string(text_of(bytes)), "fuzz.nc"), options);
  std::size_t blocks = 0;
  auto block = reader.next();
  for (; block && *block; block = reader.next()) {
    promise(is_sound(**block), "a block of the reader is not sound");
    promise((*block)->start == position, "a block does not start where the last one ended");
    position = (*block)->end;
    promise(++blocks <= 4 * (bytes.size() + kMostLines) + 4, "more blocks than the text can hold");
  }
  const auto again = reader.next();
  promise(block.has_value() == again.has_value(), "the end of the program does not stay");
  if (!block) {
    promise(!block.error().message.empty(), "an error without a message");
    promise(to_string(block.error()) == to_string(again.error()), "an error does not stay");
    read_on(reader);
  }
  promise(reader.bytes_read() <= reader.size(), "more bytes read than there are");
}

}  // namespace reader_target

const Target kReader{"reader", reader_target::run};

}  // namespace twin::fuzz
