#include "gcode/start.hpp"

#include "gcode/reader.hpp"

namespace twin::gcode {
namespace {

constexpr int kBlocksLookedAt = 100;

}  // namespace

Vec3 start_of(const ProgramText& program, const ReaderOptions& options) {
  if (!options.lifts_start || options.start.z() != 0.0) {
    return options.start;
  }
  ReaderOptions plain = options;
  plain.lifts_start = false;
  Reader reader(program, plain);
  bool has_moved = false;
  for (int i = 0; i < kBlocksLookedAt; ++i) {
    const auto next = reader.next();
    if (!next || !*next) {
      break;
    }
    const Block& block = **next;
    if (block.motion == Motion::kDwell) {
      continue;
    }
    const bool goes_across = block.start.head<2>() != block.end.head<2>();
    if (block.motion != Motion::kRapid || (!has_moved && !goes_across) || block.end.z() < 0.0) {
      break;
    }
    has_moved = true;
    if (block.end.z() > 0.0) {
      return {options.start.x(), options.start.y(), block.end.z()};
    }
  }
  return options.start;
}

}  // namespace twin::gcode
