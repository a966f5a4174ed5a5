#include "identify/judge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace twin::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDifference = 1e-4;  // of the unit cube
constexpr double kAtBound = 1e-6;     // from a bound, of the unit cube
constexpr double kTogether = 0.8;     // correlation from which on two parameters move together

/// Change of a parameter per unit of its range, relative to its value or its natural size.
double relative_per_unit(const Candidate& candidate, double value) {
  const Parameter& p = candidate.parameter;
  if (p.scale == Scale::kLogarithmic) {
    return std::log(p.max / p.min);
  }
  return (p.max - p.min) / std::max({std::abs(value), candidate.natural, 1e-12});
}

double value_per_unit(const Candidate& candidate, double value) {
  const Parameter& p = candidate.parameter;
  return p.scale == Scale::kLogarithmic ? value * std::log(p.max / p.min) : p.max - p.min;
}

/// Names of those that a parameter moves together with.
std::string partners(const std::vector<const Candidate*>& candidates,
                     const std::vector<Index>& kept, const MatrixXd& covariance, Index place) {
  std::string names;
  for (Index i = 0; i < covariance.rows(); ++i) {
    const double correlation =
        covariance(i, place) / std::sqrt(covariance(i, i) * covariance(place, place));
    if (i != place && std::abs(correlation) > kTogether) {
      names += (names.empty() ? "" : ", ") +
               candidates[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])]->name;
    }
  }
  return names.empty() ? "too little effect in these data" : "shows only together with " + names;
}

/// Columns of a matrix.
MatrixXd columns_of(const MatrixXd& matrix, const std::vector<Index>& kept) {
  MatrixXd result(matrix.rows(), static_cast<Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    result.col(static_cast<Index>(i)) = matrix.col(kept[i]);
  }
  return result;
}

/// At a bound that is only where the search ends; 0 and other least values that there can be are
/// values like others.
bool is_at_bound(const Candidate& candidate, double unit) {
  return unit > 1.0 - kAtBound ||
         (unit < kAtBound && candidate.parameter.scale == Scale::kLogarithmic);
}

}  // namespace

Judgement judge(const std::vector<const Candidate*>& candidates, const std::vector<double>& units,
                const std::vector<double>& values, const Residuals& residuals, Index block) {
  Judgement judgement(candidates.size());
  const VectorXd x = Eigen::Map<const VectorXd>(units.data(), static_cast<Index>(units.size()));
  const VectorXd residual = residuals(x);
  const MatrixXd j = jacobian(residuals, x, residual, kDifference);
  std::vector<Index> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    kept.push_back(static_cast<Index>(i));
  }
  while (!kept.empty()) {
    const MatrixXd covariance = block_covariance(columns_of(j, kept), residual, block);
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto place = static_cast<std::size_t>(kept[i]);
      const Candidate& candidate = *candidates[place];
      const auto diagonal = static_cast<Index>(i);
      const double sigma = std::sqrt(covariance(diagonal, diagonal));
      judgement[place].relative = sigma * relative_per_unit(candidate, values[place]);
      judgement[place].sigma = sigma * value_per_unit(candidate, values[place]);
      if (judgement[place].relative > kMostRelative &&
          (!worst ||
           candidate.hold_rank < candidates[static_cast<std::size_t>(kept[*worst])]->hold_rank)) {
        worst = i;
      }
    }
    if (!worst) {
      break;
    }
    const auto place = static_cast<std::size_t>(kept[*worst]);
    judgement[place].verdict = Verdict::kUnidentified;
    judgement[place].why = partners(candidates, kept, covariance, static_cast<Index>(*worst));
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(*worst));
  }
  for (const Index i : kept) {
    const auto place = static_cast<std::size_t>(i);
    if (is_at_bound(*candidates[place], units[place])) {
      judgement[place].verdict = Verdict::kAtBound;
      judgement[place].why = "best at the end of its range";
    }
  }
  return judgement;
}

}  // namespace twin::identify
