#include "studies/identify/inverse_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/linear_algebra.hpp"
#include "core/units.hpp"
#include "studies/identify/least_squares.hpp"

namespace twin::studies::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShortestSmoothing = 4.0;  // standard deviation of the kernel [rows]
constexpr double kLongestSmoothing = 24.0;  // [rows]
constexpr double kLongerBy = 1.5;           // in the refit with a longer smoothing
constexpr double kMostNoise = 0.03;         // of the quantum in a, relative to a
constexpr double kKernelReach = 4.0;        // standard deviations
constexpr double kRestShare = 0.01;         // of the peak velocity, below which it rests
constexpr double kTurnShare = 0.001;        // of the peak velocity, within which sgn v turns
constexpr Index kFewestMoving = 20;         // in a direction that tell of it
constexpr double kFastRows = 0.2;           // of the peak velocity, in the refit of fast rows
constexpr double kStribeckShare = 0.1;      // of the peak velocity, in the refit with Stribeck
constexpr double kScoreTime = 0.25;         // within which residuals may be correlated [s]
constexpr std::array<Index, 6> kLags{-4, -2, -1,
                                     1,  2,  4};  // of the force, that a refit tries [rows]
constexpr double kUsualAsymmetry = 0.2;  // of Coulomb friction, which is the same force as weight
constexpr double kTells = 0.1;           // share of the residual's variance that is said

/// Rows of (1), of all records.
struct Regression {
  VectorXd acceleration;                // [mm/s^2]
  VectorXd velocity;                    // [mm/s]
  VectorXd speed;                       // smoothed |v| [mm/s]
  VectorXd direction;                   // smoothed sgn v
  VectorXd position;                    // [mm]
  VectorXd force;                       // [N]
  double peak = 0.0;                    // of the velocity [mm/s]
  std::vector<VectorXd> shifted_force;  // earlier and later by a few rows [N]
};

VectorXd kernel_of(double sigma) {
  const auto reach = static_cast<Index>(std::ceil(kKernelReach * sigma));
  VectorXd kernel(2 * reach + 1);
  for (Index i = 0; i < kernel.size(); ++i) {
    const double x = static_cast<double>(i - reach) / sigma;
    kernel[i] = std::exp(-0.5 * x * x);
  }
  return kernel / kernel.sum();
}

/// Smooths where the whole kernel has rows; elsewhere 0.
VectorXd smoothed(const VectorXd& values, const VectorXd& kernel) {
  const Index reach = kernel.size() / 2;
  VectorXd result = VectorXd::Zero(values.size());
  for (Index k = reach; k + reach < values.size(); ++k) {
    result[k] = values.segment(k - reach, kernel.size()).dot(kernel);
  }
  return result;
}

VectorXd first_difference(const VectorXd& values, double period) {
  VectorXd result = VectorXd::Zero(values.size());
  for (Index k = 1; k + 1 < values.size(); ++k) {
    result[k] = (values[k + 1] - values[k - 1]) / (2.0 * period);
  }
  return result;
}

VectorXd second_difference(const VectorXd& values, double period) {
  VectorXd result = VectorXd::Zero(values.size());
  for (Index k = 1; k + 1 < values.size(); ++k) {
    result[k] = (values[k + 1] - 2.0 * values[k] + values[k - 1]) / (period * period);
  }
  return result;
}

/// The motion of a record and its force, smoothed alike.
struct Smoothed {
  VectorXd position;
  VectorXd velocity;
  VectorXd acceleration;
  VectorXd speed;
  VectorXd direction;
  VectorXd force;
  Index margin = 0;  // rows at each end that are not smoothed
};

Smoothed smoothed_record(const AxisRecord& record, double period, double sigma) {
  const VectorXd kernel = kernel_of(sigma);
  const auto rows = static_cast<Index>(record.measured.size());
  const VectorXd position =
      Eigen::Map<const VectorXd>(record.measured.data(), rows).array() - record.measured.front();
  Smoothed result;
  result.position = smoothed(position, kernel);
  const VectorXd raw_velocity = first_difference(position, period);
  result.velocity = smoothed(raw_velocity, kernel);
  result.acceleration = smoothed(second_difference(position, period), kernel);
  const VectorXd calm = result.velocity;
  const double turn = std::max(kTurnShare * calm.cwiseAbs().maxCoeff(), 1e-12);
  const VectorXd sign =
      calm.unaryExpr([turn](double v) { return std::clamp(v / turn, -1.0, 1.0); });
  result.direction = smoothed(sign, kernel);
  result.speed = smoothed(calm.cwiseAbs(), kernel);
  result.force = smoothed(Eigen::Map<const VectorXd>(record.force.data(), rows), kernel);
  result.margin = kernel.size() + 1;
  return result;
}

/// Rows near which the axis moves, and all of whose kernel counts.
std::vector<Index> moving_rows(const Smoothed& s, const AxisRecord& record, double peak,
                               double sigma) {
  const double rest = kRestShare * peak;
  const auto near = static_cast<Index>(std::ceil(2.0 * sigma));
  std::vector<Index> rows;
  for (Index k = s.margin; k + s.margin < s.velocity.size(); ++k) {
    const bool moves = s.velocity.segment(k - near, 2 * near + 1).cwiseAbs().minCoeff() > rest ||
                       s.velocity.segment(k - near, 2 * near + 1).maxCoeff() > rest ||
                       s.velocity.segment(k - near, 2 * near + 1).minCoeff() < -rest;
    if (moves && record.counts(static_cast<std::size_t>(k))) {
      rows.push_back(k);
    }
  }
  return rows;
}

Regression regression_of(std::span<const AxisRecord> records, double period, double sigma) {
  std::vector<Smoothed> all;
  Regression result;
  for (const AxisRecord& record : records) {
    all.push_back(smoothed_record(record, period, sigma));
    result.peak = std::max(result.peak, all.back().velocity.cwiseAbs().maxCoeff());
  }
  std::array<std::vector<double>, 6> columns;
  std::array<std::vector<double>, kLags.size()> shifted;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Index k : moving_rows(all[i], records[i], result.peak, sigma)) {
      const std::array values{all[i].acceleration[k], all[i].velocity[k], all[i].speed[k],
                              all[i].direction[k],    all[i].position[k], all[i].force[k]};
      for (std::size_t c = 0; c < values.size(); ++c) {
        columns[c].push_back(values[c]);
      }
      for (std::size_t lag = 0; lag < kLags.size(); ++lag) {
        const Index at = std::clamp<Index>(k + kLags[lag], 0, all[i].force.size() - 1);
        shifted[lag].push_back(all[i].force[at]);
      }
    }
  }
  const auto vector = [](const std::vector<double>& x) {
    return VectorXd(Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size())));
  };
  result.acceleration = vector(columns[0]);
  result.velocity = vector(columns[1]);
  result.speed = vector(columns[2]);
  result.direction = vector(columns[3]);
  result.position = vector(columns[4]);
  result.force = vector(columns[5]);
  for (const auto& force : shifted) {
    result.shifted_force.push_back(vector(force));
  }
  return result;
}

/// A smoothing that keeps the noise of the quantum in a small [rows].
double smoothing_for(std::span<const AxisRecord> records, double period, double quantum) {
  double sigma = kShortestSmoothing;
  for (; sigma < kLongestSmoothing; sigma *= 1.25) {
    const Regression rows = regression_of(records, period, sigma);
    const double a = rows.acceleration.size() > 0
                         ? std::sqrt(rows.acceleration.squaredNorm() /
                                     static_cast<double>(rows.acceleration.size()))
                         : 0.0;
    // White noise of a variance s^2 behind a Gaussian kernel's second derivative.
    const double noise = quantum / std::sqrt(12.0) * std::sqrt(3.0 / (8.0 * std::sqrt(M_PI))) /
                         std::pow(sigma, 2.5) / (period * period);
    if (noise <= kMostNoise * a) {
      break;
    }
  }
  return sigma;
}

/// Columns M, Fv, Fc, W and, for friction in two ways, dFv. A motion in one direction only has the
/// first three: its sgn v is constant, so that W is a part of Fc.
MatrixXd columns_of_model(const Regression& rows, Directions directions, bool has_weight) {
  MatrixXd w(rows.force.size(), !has_weight ? 3 : directions == Directions::kTwoWay ? 5 : 4);
  w.col(0) = rows.acceleration;
  w.col(1) = rows.velocity;
  w.col(2) = rows.direction;
  if (has_weight) {
    w.col(3).setOnes();
  }
  if (w.cols() == 5) {
    w.col(4) = rows.speed;
  }
  return w;
}

bool has_both_ways(const Regression& rows) {
  const double rest = kRestShare * rows.peak;
  return (rows.velocity.array() > rest).count() >= kFewestMoving &&
         (rows.velocity.array() < -rest).count() >= kFewestMoving;
}

VectorXd solved(const MatrixXd& w, const VectorXd& force) {
  return transposed_product(normal_inverse(w), transposed_product(w, force));
}

/// The same regression without the slower rows.
Regression fast_rows(const Regression& rows) {
  std::vector<Index> kept;
  for (Index k = 0; k < rows.velocity.size(); ++k) {
    if (std::abs(rows.velocity[k]) > kFastRows * rows.peak) {
      kept.push_back(k);
    }
  }
  const auto cut = [&](const VectorXd& all) {
    VectorXd part(static_cast<Index>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      part[static_cast<Index>(i)] = all[kept[i]];
    }
    return part;
  };
  return {cut(rows.acceleration), cut(rows.velocity), cut(rows.speed), cut(rows.direction),
          cut(rows.position),     cut(rows.force),    rows.peak,       {}};
}

/// The force earlier or later by a few rows, as it fits the motion best: clocks and filters of
/// force and position may differ.
VectorXd force_at_best_lag(const Regression& rows, const MatrixXd& w) {
  VectorXd best = rows.force;
  double least = (rows.force - w.lazyProduct(solved(w, rows.force))).squaredNorm();
  for (const VectorXd& force : rows.shifted_force) {
    const double cost = (force - w.lazyProduct(solved(w, force))).squaredNorm();
    if (cost < least) {
      least = cost;
      best = force;
    }
  }
  return best;
}

/// Coefficients M, Fv, Fc and perhaps W by other models and other rows.
std::vector<VectorXd> refits(std::span<const AxisRecord> records, const Regression& rows,
                             double period, double sigma, bool has_weight) {
  const MatrixXd plain = columns_of_model(rows, Directions::kAlike, has_weight);
  std::vector<VectorXd> results;
  if (has_weight) {
    results.push_back(solved(columns_of_model(rows, Directions::kTwoWay, true), rows.force));
  }
  MatrixXd with_stribeck(plain.rows(), plain.cols() + 1);
  with_stribeck.leftCols(plain.cols()) = plain;
  const double width = kStribeckShare * rows.peak;
  with_stribeck.rightCols(1) =
      rows.direction.array() * (-(rows.velocity.array() / width).square()).exp();
  results.push_back(solved(with_stribeck, rows.force));
  const Regression fast = fast_rows(rows);
  if (has_both_ways(fast) == has_weight && fast.force.size() > rows.force.size() / 4) {
    results.push_back(solved(columns_of_model(fast, Directions::kAlike, has_weight), fast.force));
  }
  results.push_back(solved(plain, force_at_best_lag(rows, plain)));
  const Regression longer = regression_of(records, period, kLongerBy * sigma);
  if (has_both_ways(longer) == has_weight && longer.force.size() > rows.force.size() / 4) {
    results.push_back(
        solved(columns_of_model(longer, Directions::kAlike, has_weight), longer.force));
  }
  return results;
}

/// Says what a residual goes with: the share of its variance that a straight line explains.
std::vector<std::string> what_it_goes_with(const VectorXd& residual, const Regression& rows,
                                           bool has_weight) {
  if (!has_weight) {
    return {};
  }
  struct Cause {
    const char* name;
    VectorXd values;
  };
  const VectorXd plus = rows.velocity.unaryExpr([](double v) { return std::max(v, 0.0); });
  const VectorXd slow = rows.direction.array() *
                        (-(rows.velocity.array() / (kStribeckShare * rows.peak)).square()).exp();
  const std::array causes{Cause{"speed in one direction (friction differs either way)", plus},
                          Cause{"slow motion (Stribeck friction)", slow},
                          Cause{"position", rows.position},
                          Cause{"size of the acceleration", rows.acceleration.cwiseAbs()}};
  std::vector<std::string> said;
  for (const Cause& cause : causes) {
    MatrixXd w(residual.size(), 5);
    w.leftCols(4) = columns_of_model(rows, Directions::kAlike, true);
    w.col(4) = cause.values;
    const VectorXd left = residual - w.lazyProduct(solved(w, residual));
    const double share = 1.0 - left.squaredNorm() / residual.squaredNorm();
    if (share > kTells) {
      said.push_back(fmt::format("{}: {:.0f} %", cause.name, 100.0 * share));
    }
  }
  return said;
}

}  // namespace

double InverseModel::force(double a, double v) const noexcept {
  const double direction = v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
  return units::m_from_mm(mass.value * a) + viscous.value * v +
         viscous_asymmetry.value * std::abs(v) + coulomb.value * direction + weight.value;
}

InverseModel fit_inverse_model(std::span<const AxisRecord> records, double period, double quantum,
                               Directions directions) {
  const double sigma = smoothing_for(records, period, quantum);
  const Regression rows = regression_of(records, period, sigma);
  InverseModel model;
  model.rows = static_cast<std::size_t>(rows.force.size());
  if (rows.force.size() < kFewestMoving) {
    return model;
  }
  const bool has_weight = model.has_both_directions = has_both_ways(rows);
  model.is_two_way = directions == Directions::kTwoWay && has_weight;
  const MatrixXd w = columns_of_model(rows, directions, has_weight);
  const VectorXd fit = solved(w, rows.force);
  const VectorXd residual = rows.force - w.lazyProduct(fit);
  const MatrixXd covariance =
      block_covariance(w, residual, static_cast<Index>(std::lround(kScoreTime / period)));
  VectorXd spread = VectorXd::Zero(fit.size());
  const std::vector<VectorXd> others = refits(records, rows, period, sigma, has_weight);
  const Index shared = std::min<Index>(fit.size(), 4);
  for (const VectorXd& other : others) {
    spread.head(shared) =
        spread.head(shared).cwiseMax((other.head(shared) - fit.head(shared)).cwiseAbs2());
  }
  const auto coefficient = [&](Index i, double to_base) {
    return Coefficient{fit[i] * to_base, std::sqrt(covariance(i, i) + spread[i]) * to_base};
  };
  model.mass = coefficient(0, 1e3);
  model.viscous = coefficient(1, 1.0);
  model.coulomb = coefficient(2, 1.0);
  model.weight = has_weight ? coefficient(3, 1.0) : Coefficient{};
  model.weight.sigma =
      std::hypot(model.weight.sigma, has_weight ? kUsualAsymmetry * model.coulomb.value : 0.0);
  if (model.is_two_way) {
    model.viscous_asymmetry = coefficient(4, 1.0);
  }
  model.force_rms = std::sqrt(rows.force.squaredNorm() / static_cast<double>(rows.force.size()));
  model.relative_error = residual.norm() / rows.force.norm();
  model.seems_to_lack = what_it_goes_with(residual, rows, has_weight);
  return model;
}

double force_error(const InverseModel& model, std::span<const AxisRecord> records, double period,
                   double quantum) {
  const Regression rows = regression_of(records, period, smoothing_for(records, period, quantum));
  VectorXd left = rows.force - rows.acceleration * units::m_from_mm(model.mass.value) -
                  rows.velocity * model.viscous.value - rows.direction * model.coulomb.value -
                  rows.speed * model.viscous_asymmetry.value;
  left.array() -= model.weight.value;
  return left.norm() / rows.force.norm();
}

}  // namespace twin::studies::identify
