#include "gcode/interpreter/threading_cycle.hpp"

#include <cmath>

namespace twin::gcode {

ThreadingCycle::ThreadingCycle(const ThreadLine& line) : line_(line), is_done_(false) {}

/// Adds a move to a distance from the drive line and a place along Z.
void ThreadingCycle::add(double across, double along, double feedrate) {
  const double sense = line_.crest > 0.0 ? 1.0 : -1.0;
  moves_[count_++] = {{line_.start.x() + sense * across * line_.unit, line_.start.y(), along},
                      feedrate};
}

/// Makes the moves of the next pass, or none if all have been.
void ThreadingCycle::begin_pass() {
  count_ = next_ = 0;
  if (final_ > line_.spring_cuts) {
    return;
  }
  const double crest = std::abs(line_.crest);
  const double full = line_.height + crest;
  double depth = full;
  if (final_ == 0) {
    ++pass_;
    depth = crest + line_.first_cut * std::pow(static_cast<double>(pass_), 1.0 / line_.degression);
  }
  if (!(depth < full)) {
    depth = full;
    ++final_;
  }
  const bool goes_up = line_.end.z() > line_.start.z();
  const double slope = std::tan(goes_up ? -line_.angle : line_.angle) * line_.unit;
  const double shift = (depth - crest) * slope;
  const double first = line_.start.z() - shift;
  const double last = line_.end.z() + line_.height * slope - shift;
  const double taper = (goes_up ? -line_.taper : line_.taper) * line_.unit;
  const double taper_feedrate =
      line_.taper > 0.0 ? line_.feedrate * std::hypot(line_.taper, line_.height) / line_.taper
                        : line_.feedrate;
  add(depth - full, first, 0.0);
  if (line_.has_entry && line_.taper > 0.0) {
    add(depth - line_.height, first, taper_feedrate);
    add(depth, first - taper, taper_feedrate);
  } else {
    add(depth, first, 0.0);
  }
  if (line_.has_exit && line_.taper > 0.0) {
    add(depth, last + taper, line_.feedrate);
    add(depth - line_.height, last, taper_feedrate);
  } else {
    add(depth, last, line_.feedrate);
  }
  add(depth - full, last, 0.0);
}

std::optional<ThreadMove> ThreadingCycle::next() {
  if (is_done_) {
    return std::nullopt;
  }
  if (next_ == count_) {
    begin_pass();
  }
  if (count_ > 0) {
    return moves_[next_++];
  }
  is_done_ = true;
  return ThreadMove{line_.end, 0.0};
}

}  // namespace twin::gcode
