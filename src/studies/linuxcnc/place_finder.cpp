#include "studies/linuxcnc/place_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "results/metrics/block_distance.hpp"

namespace twin::studies::linuxcnc {
namespace {

constexpr double kWeight = 0.1;  // of the arc length against the distance [-]
constexpr double kReach = 2.0;   // ahead of where the place is expected, and behind it [mm]

}  // namespace

Expected<void> PlaceFinder::read_to(double arc_length) {
  while (!has_ended_ && known_ < arc_length) {
    TWIN_TRY(std::optional<gcode::Block> next, blocks_());
    if (!next) {
      has_ended_ = true;
      break;
    }
    const double length = results::block_length(*next, results::View::kSpace);
    pieces_.push_back({std::move(*next), known_, length});
    known_ += length;
  }
  return {};
}

Expected<std::int64_t> PlaceFinder::find(const Vec3& point) {
  const double way = has_begun_ ? (point - last_).norm() : 0.0;
  const double expected = place_ + way;
  const double reach = kReach + way;
  TWIN_CHECK(read_to(expected + reach));
  double best = std::numeric_limits<double>::infinity();
  double place = place_;
  double distance = 0.0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < pieces_.size() && pieces_[i].begin <= expected + reach; ++i) {
    const Piece& piece = pieces_[i];
    const auto share = [&](double s) {
      return piece.length > 0.0 ? std::clamp((s - piece.begin) / piece.length, 0.0, 1.0) : 1.0;
    };
    const results::NearestPoint nearest =
        results::nearest(piece.block, point, results::View::kSpace, share(place_ - 0.1 * kReach),
                         share(expected + reach));
    const double s = piece.begin + nearest.fraction * piece.length;
    const double cost = nearest.distance + kWeight * std::abs(s - expected);
    if (cost < best) {
      best = cost;
      place = s;
      distance = nearest.distance;
      found = i;
    }
  }
  last_ = point;
  has_begun_ = true;
  place_ = place;
  largest_distance_ = std::max(largest_distance_, distance);
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(found));
  first_ += static_cast<std::int64_t>(found);
  return first_;
}

}  // namespace twin::studies::linuxcnc
