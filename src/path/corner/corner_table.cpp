#include "path/corner/corner_table.hpp"

#include <algorithm>
#include <cmath>

namespace twin::path {
namespace {

/// Step of the lattice of log(tan(phi / 2)). It is the share of the tolerance that corners between
/// two places of the lattice lose, and half of it is the share of the time. With half the step,
/// twice as many corners have to be solved.
constexpr double kStep = 0.01;

/// Share of the jerk of the path that a solution may use: the stretched motion has another one, by the
/// ratio of velocities along y and x, twice in the square of the normal acceleration.
constexpr double kStretchedJerkUsed = 0.98;

/// Most passages that are kept; then the table is emptied. It bounds the memory, to 4 megabytes.
constexpr std::size_t kMostKept = 8192;

/// The lattice ends there. Beyond, the path turns back or goes on, within a hundredth of a degree,
/// and the passage at the end of the lattice is pressed flat.
constexpr long kLast = 900;
constexpr double kLeast = 1e-9;  // of a cosine

/// Parts of an axis that are told apart, to 1. So much of its limits is lost at most, and with twice
/// as many, corners of one turn share half as many solutions.
constexpr double kParts = 512.0;

/// Parts of the axes along the two directions of a corner's plane, rounded up.
void set_parts(const Vec3& x, const Vec3& y, std::array<CornerAxis, 3>& axes) {
  const auto rounded = [](double part) {
    return std::ceil(std::abs(part) * kParts - 1e-6) / kParts;
  };
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vec2 part(rounded(x[k]), rounded(y[k]));
    axes[i] =
        part.isZero(0.0) ? CornerAxis{} : CornerAxis{part, axes[i].acceleration, axes[i].jerk};
  }
}

}  // namespace

std::optional<CornerMotion> CornerTable::find(const Vec3& corner, const Vec3& incoming,
                                              const Vec3& outgoing, CornerDemand demand) {
  const Vec3 inside = outgoing - incoming;
  const double sine = 0.5 * inside.norm();  // of half the turn
  const Vec3 along = 0.5 * (incoming + outgoing);
  const double cosine = along.norm();
  const long place =
      std::clamp(std::lround(std::log(sine / std::max(cosine, kLeast)) / kStep), -kLast, kLast);
  const double half_turn = std::atan(std::exp(static_cast<double>(place) * kStep));
  const Vec2 stretch(cosine / std::cos(half_turn), sine / std::sin(half_turn));
  const double most = stretch.maxCoeff();
  // Space and time are scaled by one factor, so that the feedrate stays. The acceleration is divided
  // by it, the jerk by its square, and both are stretched by `most` at the utmost.
  const double scale = std::max(most, 1.0);
  set_parts(along / std::max(cosine, kLeast), inside / (2.0 * sine), demand.axes);
  Key key{static_cast<double>(place), demand.feedrate, demand.tolerance,
          demand.acceleration,        demand.jerk,     demand.path_jerk};
  for (std::size_t i = 0; i < demand.axes.size(); ++i) {
    const CornerAxis& axis = demand.axes[i];
    const std::array<double, 4> values{axis.part.x(), axis.part.y(), axis.acceleration, axis.jerk};
    std::copy(values.begin(), values.end(), key.begin() + static_cast<std::ptrdiff_t>(6 + 4 * i));
  }
  auto found = halves_.find(key);
  if (found == halves_.end()) {
    if (halves_.size() >= kMostKept) {
      halves_.clear();
    }
    demand.half_turn = half_turn;
    demand.tolerance *= std::exp(-kStep);  // for the largest stretch and scale
    demand.path_jerk *= kStretchedJerkUsed;
    const std::optional<HalfCorner> half = solve_half_corner(demand);
    found = halves_.emplace(key, half ? std::make_shared<const HalfCorner>(*half) : nullptr).first;
  }
  if (found->second == nullptr) {
    return std::nullopt;
  }
  CornerMotion passage;
  passage.half = found->second;
  passage.corner = corner;
  passage.x = scale / std::cos(half_turn) * along;
  passage.y = scale * stretch.y() * inside / inside.norm();
  passage.scale = scale;
  passage.feedrate = demand.feedrate;
  passage.acceleration = demand.least_acceleration();
  passage.jerk = demand.least_jerk();
  passage.way = scale * passage.half->way *
                std::hypot(stretch.x() * std::cos(half_turn), stretch.y() * std::sin(half_turn));
  passage.deviation =
      scale * passage.half->deviation * std::max(stretch.x() * stretch.y(), stretch.y());
  return passage;
}

}  // namespace twin::path
