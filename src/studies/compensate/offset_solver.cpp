#include "studies/compensate/offset_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace twin::studies::compensate {
namespace {

constexpr double kAlong = 0.05;      // weight of an error along the path
constexpr double kStill = 0.05;      // feedrate below which both directions count [mm/s]
constexpr double kSlow = 4.0;        // feedrate below which motion across is as motion along [mm/s]
constexpr double kNoticed = 5e-4;    // error whose direction is looked at [mm]
constexpr double kSlanted = 0.5;     // share of it along the path that is no rounding
constexpr std::ptrdiff_t kNear = 2;  // periods about it that are taken the same
constexpr double kTangentialHz = 15.0;  // of j_k to begin with
constexpr double kStandsBelow = 0.02;   // feedrate of an axis at which it stands [mm/s]
constexpr std::size_t kGrip = 50;       // periods from the end of its motion until it stands still
constexpr double kStandingHz = 2.0;     // above which an axis that stands does not answer
constexpr double kRelaxed = 0.1;        // of the weights j_k and a_k before they are held anew
constexpr double kAtEnds = 1e6;         // weight of what moves before and behind the path
constexpr double kNormalHz = 60.0;      // of a_k when it is first raised
constexpr int kMostSteps = 60;          // of the conjugate gradients
constexpr double kResidual = 1e-4;      // of the right side, at which they end

double sixth_power(double x) { return x * x * x * x * x * x; }

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Component of interleaved vectors x_0, y_0, x_1, y_1, ...
std::vector<double> every_second(std::span<const double> values, std::size_t first) {
  std::vector<double> out(values.size() / 2);
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = values[2 * k + first];
  }
  return out;
}

std::vector<double> flat(std::span<const Vec2> vectors) {
  std::vector<double> values;
  values.reserve(2 * vectors.size());
  for (const Vec2& v : vectors) {
    values.push_back(v.x());
    values.push_back(v.y());
  }
  return values;
}

/// Adds weight (sum_i c_i (u o_(first + i)))^2, with indices beyond the ends clamped to them.
template <std::size_t n>
void add_square(BandMatrix& matrix, std::ptrdiff_t first, const std::array<double, n>& c,
                const Vec2& u, double weight) {
  const auto last = static_cast<std::ptrdiff_t>(matrix.size() / 2) - 1;
  std::array<double, 2 * n> row{};
  std::array<std::size_t, 2 * n> place{};
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(i), 0, last));
    row[2 * i] = c[i] * u.x();
    row[2 * i + 1] = c[i] * u.y();
    place[2 * i] = 2 * k;
    place[2 * i + 1] = 2 * k + 1;
  }
  for (std::size_t i = 0; i < 2 * n; ++i) {
    for (std::size_t j = 0; j < 2 * n; ++j) {
      if (place[i] > place[j] || i == j) {
        matrix.add(place[i], place[j], weight * row[i] * row[j]);
      } else if (place[i] == place[j]) {
        matrix.add(place[i], place[j], weight * row[i] * row[j]);  // folded at an end
      }
    }
  }
}

/// Where an axis stands still: all periods that are kGrip away from any motion of it.
std::vector<bool> standing(std::span<const motion::SetPoint> points, Eigen::Index axis) {
  std::vector<bool> stands(points.size(), true);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (std::abs(points[k].velocity[axis]) > kStandsBelow) {
      const std::size_t end = std::min(k + kGrip + 1, points.size());
      std::fill(stands.begin() + static_cast<std::ptrdiff_t>(k - std::min(k, kGrip)),
                stands.begin() + static_cast<std::ptrdiff_t>(end), false);
    }
  }
  return stands;
}

}  // namespace

OffsetSolver::OffsetSolver(std::span<const motion::SetPoint> points, double period,
                           const std::array<Filter, 2>& responses,
                           const std::array<double, 2>& cut_off)
    : period_(period), responses_(responses) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    smoothness_[axis] = 1.0 / sixth_power(2.0 * std::numbers::pi * cut_off[axis] * period);
    stands_[axis] = standing(points, static_cast<Eigen::Index>(axis));
  }
  Vec2 tangent = Vec2::UnitX();
  for (const motion::SetPoint& point : points) {
    const double speed = point.velocity.head<2>().norm();
    if (speed > kStill) {
      tangent = point.velocity.head<2>() / speed;
    }
    tangents_.push_back(tangent);
    const double slow = kSlow / std::max(speed, kSlow);
    sideways_.push_back(slow * slow);
    is_free_along_.push_back(speed > kStill);
  }
  least_tangential_ = 1.0 / sixth_power(2.0 * std::numbers::pi * kTangentialHz * period);
  tangential_.assign(points.size(), least_tangential_);
  normal_.assign(points.size(), 0.0);
  prepare();
}

void OffsetSolver::note_corners(std::span<const Vec2> errors) {
  const auto count = static_cast<std::ptrdiff_t>(errors.size());
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double size = errors[i].norm();
    if (size < kNoticed || std::abs(errors[i].dot(tangents_[i])) < kSlanted * size) {
      continue;
    }
    for (std::ptrdiff_t near = std::max<std::ptrdiff_t>(k - kNear, 0);
         near <= std::min(k + kNear, count - 1); ++near) {
      is_free_along_[static_cast<std::size_t>(near)] = false;
    }
  }
  prepare();
}

void OffsetSolver::relax() {
  for (std::size_t k = 0; k < tangential_.size(); ++k) {
    tangential_[k] = std::max(kRelaxed * tangential_[k], least_tangential_);
    normal_[k] *= kRelaxed;
  }
  prepare();
}

void OffsetSolver::hold(std::span<const double> tangential, std::span<const double> normal) {
  const double least = 1.0 / std::pow(2.0 * std::numbers::pi * kNormalHz * period_, 4.0);
  for (std::size_t k = 0; k < tangential_.size(); ++k) {
    tangential_[k] *= tangential[k];
    if (normal[k] > 1.0) {
      normal_[k] = std::max(normal_[k], least) * normal[k];
    }
  }
  prepare();
}

void OffsetSolver::add_weights() {
  const auto count = static_cast<std::ptrdiff_t>(tangents_.size());
  constexpr std::array<double, 4> kThird{-1.0, 3.0, -3.0, 1.0};
  constexpr std::array<double, 3> kSecond{1.0, -2.0, 1.0};
  constexpr std::array<double, 2> kFirst{-1.0, 1.0};
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec2& t = tangents_[i];
    add_square(penalty_, k - 1, kThird, Vec2::UnitX(), smoothness_[0]);
    add_square(penalty_, k - 1, kThird, Vec2::UnitY(), smoothness_[1]);
    add_square(penalty_, k - 1, kThird, t, tangential_[i]);
    add_square(penalty_, k - 1, kThird, Vec2(-t.y(), t.x()), sideways_[i] * tangential_[i]);
    if (normal_[i] > 0.0) {
      add_square(penalty_, k - 1, kSecond, Vec2(-t.y(), t.x()), normal_[i]);
    }
  }
  const double held = std::pow(2.0 * std::numbers::pi * kStandingHz * period_, -2.0);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::ptrdiff_t k = 0; k + 1 < count; ++k) {
      if (stands_[axis][static_cast<std::size_t>(k)]) {
        add_square(penalty_, k, kFirst, Vec2::Unit(static_cast<Eigen::Index>(axis)), held);
      }
    }
  }
  for (std::ptrdiff_t k = 0; k < std::min<std::ptrdiff_t>(3, count - 1); ++k) {
    for (const std::ptrdiff_t first : {k, count - 2 - k}) {
      add_square(penalty_, first, kFirst, Vec2::UnitX(), kAtEnds);
      add_square(penalty_, first, kFirst, Vec2::UnitY(), kAtEnds);
    }
  }
}

void OffsetSolver::prepare() {
  penalty_ = BandMatrix(2 * tangents_.size());
  add_weights();
  preconditioner_ = penalty_;
  for (std::size_t k = 0; k < tangents_.size(); ++k) {
    const Vec2& t = tangents_[k];
    const double along = is_free_along_[k] ? 1.0 - kAlong * kAlong : 0.0;
    preconditioner_.add(2 * k, 2 * k, 1.0 - along * t.x() * t.x());
    preconditioner_.add(2 * k + 1, 2 * k, -along * t.x() * t.y());
    preconditioner_.add(2 * k + 1, 2 * k + 1, 1.0 - along * t.y() * t.y());
  }
  preconditioner_.factor();
}

/// G times offsets.
std::vector<double> OffsetSolver::responded(std::span<const double> offsets) const {
  std::vector<double> out(offsets.size());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::vector<double> one = responses_[axis].apply(every_second(offsets, axis));
    for (std::size_t k = 0; k < one.size(); ++k) {
      out[2 * k + axis] = one[k];
    }
  }
  return out;
}

/// The transpose of G times errors.
std::vector<double> OffsetSolver::responded_back(std::span<const double> errors) const {
  std::vector<double> out(errors.size());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::vector<double> one = responses_[axis].apply_transposed(every_second(errors, axis));
    for (std::size_t k = 0; k < one.size(); ++k) {
      out[2 * k + axis] = one[k];
    }
  }
  return out;
}

/// P times errors.
std::vector<double> OffsetSolver::weighted(std::span<const double> errors) const {
  std::vector<double> out(errors.begin(), errors.end());
  for (std::size_t k = 0; k < tangents_.size(); ++k) {
    if (is_free_along_[k]) {
      const Vec2& t = tangents_[k];
      const double along =
          (1.0 - kAlong * kAlong) * (t.x() * errors[2 * k] + t.y() * errors[2 * k + 1]);
      out[2 * k] -= along * t.x();
      out[2 * k + 1] -= along * t.y();
    }
  }
  return out;
}

void OffsetSolver::improve(std::span<const Vec2> errors, std::vector<Vec2>& offsets) const {
  const std::vector<double> now = flat(offsets);
  std::vector<double> residual = responded_back(weighted(flat(errors)));
  const std::vector<double> held = penalty_.times(now);
  std::ranges::transform(residual, held, residual.begin(), std::minus<>());
  std::vector<double> change(residual.size(), 0.0);
  std::vector<double> direction = residual;
  preconditioner_.solve(direction);
  double rho = dot(residual, direction);
  const double enough = kResidual * kResidual * rho;
  for (int step = 0; step < kMostSteps && rho > enough && rho > 0.0; ++step) {
    std::vector<double> image = responded_back(weighted(responded(direction)));
    const std::vector<double> more = penalty_.times(direction);
    std::ranges::transform(image, more, image.begin(), std::plus<>());
    const double length = rho / dot(direction, image);
    for (std::size_t i = 0; i < change.size(); ++i) {
      change[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    std::vector<double> next = residual;
    preconditioner_.solve(next);
    const double last = rho;
    rho = dot(residual, next);
    for (std::size_t i = 0; i < direction.size(); ++i) {
      direction[i] = next[i] + rho / last * direction[i];
    }
  }
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    offsets[k] += Vec2(change[2 * k], change[2 * k + 1]);
  }
}

}  // namespace twin::studies::compensate
