#include "results/metrics/arc_steps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace twin::results {
namespace {

constexpr double kNoLength = 1e-12;  // a chord below this has no direction [mm]

}  // namespace

void ArcSteps::reset(const Vec3& point) noexcept {
  *this = ArcSteps{};
  last_ = point;
}

Step ArcSteps::push(const Vec3& point) noexcept {
  std::rotate(nodes_.begin(), nodes_.begin() + 1, nodes_.end());
  const Vec3 chord = point - last_;
  Node node;
  node.chord = chord.norm();
  if (node.chord > kNoLength) {
    const Vec3 direction = chord / node.chord;
    if (direction_ != Vec3::Zero()) {
      const Vec3 cross = direction_.cross(direction);
      node.turn = std::atan2(cross.norm(), direction_.dot(direction));
      const double span = (chord + chord_).norm();
      if (chord_.norm() > kNoLength && span > kNoLength) {
        node.curvature = 2.0 / span * cross;
      }
    }
    direction_ = direction;
  }
  nodes_[3] = node;
  chord_ = chord;
  last_ = point;

  const auto& [n0, n1, n2, n3] = nodes_;
  const double c = n1.chord;
  const Vec3 mean =
      (71.0 * (n1.curvature + n2.curvature) - 11.0 * (n0.curvature + n3.curvature)) / 120.0;
  Step step;
  step.chord = c;
  const double sine = std::min(0.5 * mean.norm() * c, 1.0);
  const double half = std::asin(sine);
  step.bend = 2.0 * half;
  step.arc = sine > 5e-10 ? c * half / sine : c;

  const double dx = c * std::max((n2.curvature - 2.0 * n1.curvature + n0.curvature).norm(),
                                 (n3.curvature - 2.0 * n2.curvature + n1.curvature).norm());
  const double lone = std::max(n1.turn + n2.turn - 2.0 * (n0.turn + n3.turn), 0.0);
  step.doubt = c / 24.0 * (2.0 * step.bend * dx + dx * dx + 3.0 * lone * lone);
  if (std::max(n1.turn, n2.turn) > kSharp) {
    step.doubt = std::max({step.doubt, n0.chord, n1.chord, n2.chord});
  }
  return step;
}

}  // namespace twin::results
