#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>

#include "core/vec.hpp"
#include "path/corner/corner_motion.hpp"

namespace twin::path {

/// The passages of a program's corners, each solved when it is first needed.
///
/// Corners of nearly the same turn share one HalfCorner. Between them the plane is stretched along x
/// and y, so that legs lie on legs and feedrates stay: velocities along x are in the ratio of the
/// cosines of the half turns, and along y in that of the sines. On a lattice of log(tan(phi / 2))
/// both ratios are within half a step of 1. Time and space are then scaled by what the jerk needs.
/// Parts of axes that have limits are rounded up to a lattice, too.
/// So a passage depends on its own corner only, not on which corners came before.
class CornerTable {
 public:
  /// @param incoming, outgoing  directions of both legs, unit vectors that are not parallel
  /// @param demand              its half turn, and the parts of its axes, are those of the legs
  /// @returns nothing where there is no such passage
  std::optional<CornerMotion> find(const Vec3& corner, const Vec3& incoming, const Vec3& outgoing,
                                   CornerDemand demand);

 private:
  using Key = std::array<double, 6 + 3 * 4>;

  std::map<Key, std::shared_ptr<const HalfCorner>> halves_;
};

}  // namespace twin::path
