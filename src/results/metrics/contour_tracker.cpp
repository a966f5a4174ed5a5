#include "results/metrics/contour_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace twin::results {
namespace {

/// A command farther than this from the path is searched for on its whole block [mm]. A smaller
/// value searches whole blocks more often; a larger one may follow a wrong turn of a spiral for
/// longer.
constexpr double kLost = 0.05;

/// Share of a gap that the search skips. It is below 1 because the arc length of a spiral is known
/// to rounding only.
constexpr double kTrusted = 0.99;

}  // namespace

void ContourTracker::add(const gcode::Block& block) {
  const double s0 = pieces_.empty() ? 0.0 : pieces_.back().s1;
  pieces_.push_back({block, s0, s0 + block_length(block, view_)});
}

double ContourTracker::ahead(std::int64_t block) const noexcept {
  const std::int64_t index = block - first_;
  if (index >= static_cast<std::int64_t>(pieces_.size())) {
    return -1.0;
  }
  return pieces_.back().s1 - pieces_[index_of(block)].s1;
}

std::size_t ContourTracker::index_of(std::int64_t block) const noexcept {
  const auto last = static_cast<std::int64_t>(pieces_.size()) - 1;
  return static_cast<std::size_t>(std::clamp<std::int64_t>(block - first_, 0, last));
}

void ContourTracker::follow(std::int64_t block, const Vec3& command) {
  if (pieces_.empty()) {
    return;
  }
  const std::size_t index = index_of(block);
  const Piece& piece = pieces_[index];
  const double block_lo = piece.s0 - kMargin;
  const double block_hi = piece.s1 + kMargin;
  Found found;
  if (has_command_) {
    const double step = separation(command, command_);
    const double lo = std::max(block_lo, place_ - kBack);
    const double hi = std::min(block_hi, place_ + 3.0 * step + kBack);
    if (lo <= hi) {
      found = search(command, lo, hi, std::max(current_, index));
    }
  }
  if (!found.is_known || found.place.distance > kLost) {
    const Found wide = search(command, block_lo, block_hi, index);
    if (!found.is_known || wide.place.distance + kLost < found.place.distance) {
      found = wide;
    }
  }
  place_ = std::max(found.s, has_command_ ? place_ : found.s);
  current_ = index;
  command_ = command;
  has_command_ = true;
  drop_old();
}

NearestPoint ContourTracker::nearest(const Vec3& position) const {
  if (!has_command_) {
    return {};
  }
  const double tracking_error = separation(position, command_);
  const double width = std::min(window_ + 4.0 * tracking_error, kReach);
  return search(position, place_ - width, place_ + width, current_).place;
}

double ContourTracker::separation(const Vec3& a, const Vec3& b) const noexcept {
  return view_ == View::kSpace ? (a - b).norm() : std::hypot(a.x() - b.x(), a.y() - b.y());
}

/// Searches one piece.
/// @returns arc length from which on (forward) or up to which (backward) a nearer place may follow
double ContourTracker::look_at(const Vec3& point, double lo, double hi, const Piece& piece,
                               Direction direction, Found& best) const {
  const bool is_forward = direction == Direction::kForward;
  const double length = piece.s1 - piece.s0;
  const double from = length > 0.0 ? std::clamp((lo - piece.s0) / length, 0.0, 1.0) : 0.0;
  const double to = length > 0.0 ? std::clamp((hi - piece.s0) / length, from, 1.0) : 1.0;
  const NearestPoint place = results::nearest(piece.block, point, view_, from, to);
  if (!best.is_known || place.distance < best.place.distance) {
    best = {place, piece.s0 + place.fraction * length, true};
  }
  const Vec3 end = is_forward ? piece.block.end : piece.block.start;
  const double gap = kTrusted * (separation(point, end) - best.place.distance);
  return is_forward ? piece.s1 + std::max(gap, 0.0) : piece.s0 - std::max(gap, 0.0);
}

ContourTracker::Found ContourTracker::search(const Vec3& point, double lo, double hi,
                                             std::size_t start) const {
  Found best;
  // The walk starts on the piece at the window's edge when the whole window lies beyond `start`.
  while (start + 1 < pieces_.size() && pieces_[start].s1 < lo) {
    ++start;
  }
  while (start > 0 && pieces_[start].s0 > hi) {
    --start;
  }
  double skip = lo;
  for (std::size_t i = start; i < pieces_.size() && pieces_[i].s0 <= hi; ++i) {
    if (pieces_[i].s1 >= skip) {
      skip = look_at(point, lo, hi, pieces_[i], Direction::kForward, best);
    }
  }
  skip = pieces_[start].s0;
  for (std::size_t i = start; i-- > 0 && pieces_[i].s1 >= lo;) {
    if (pieces_[i].s0 <= skip) {
      skip = look_at(point, lo, hi, pieces_[i], Direction::kBackward, best);
    }
  }
  return best;
}

void ContourTracker::drop_old() {
  while (current_ > 0 && pieces_.front().s1 < place_ - kReach) {
    pieces_.pop_front();
    --current_;
    ++first_;
  }
}

}  // namespace twin::results
