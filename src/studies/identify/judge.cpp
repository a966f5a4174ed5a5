#include "studies/identify/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/linear_algebra.hpp"

namespace twin::studies::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDifference = 1e-4;  // of the unit cube
constexpr double kAtBound = 1e-6;     // from a bound, of the unit cube
constexpr int kMostNames = 3;         // that a reason lists
constexpr double kHeldDoubt = 0.3;    // relative doubt of a held value, passed on to the others
constexpr double kTogether = 0.8;     // correlation from which on two parameters move together

/// Change of a parameter per unit of its range, relative to its value or its natural size.
double relative_per_unit(const Candidate& candidate, double value) {
  const Parameter& p = candidate.parameter;
  if (p.scale == Scale::kLogarithmic) {
    return std::log(p.max / p.min);
  }
  return (p.max - p.min) / std::max({std::abs(value), candidate.natural, 1e-12});
}

/// Names of those that a parameter moves together with.
std::string partners(const std::vector<JudgedCandidate>& candidates, const std::vector<Index>& kept,
                     const MatrixXd& covariance, Index place) {
  std::string names;
  int others = 0;
  for (Index i = 0; i < covariance.rows(); ++i) {
    const double correlation =
        covariance(i, place) / std::sqrt(covariance(i, i) * covariance(place, place));
    if (i == place || std::abs(correlation) < kTogether) {
      continue;
    }
    if (++others <= kMostNames) {
      names +=
          (names.empty() ? "" : ", ") +
          candidates[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])].candidate->name;
    }
  }
  if (others > kMostNames) {
    names += fmt::format(" and {} more", others - kMostNames);
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

/// Adds to the deviations of the kept what a doubt of kHeldDoubt of each held value makes of them.
///
/// A held value that is wrong by d shifts the others by -(J_k^T J_k)^-1 J_k^T J_h d. What only
/// scales with others, as the mass, is left out: the others are meant against it.
void add_doubt_of_held(const std::vector<JudgedCandidate>& candidates, const MatrixXd& j,
                       const std::vector<Index>& kept, Judgement& judgement) {
  const MatrixXd kept_columns = columns_of(j, kept);
  const MatrixXd inverse = normal_inverse(kept_columns);
  for (std::size_t h = 0; h < candidates.size(); ++h) {
    if (judgement[h].verdict == Verdict::kIdentified || candidates[h].candidate->is_analysed_only) {
      continue;
    }
    const double size = std::max(std::abs(candidates[h].value), std::abs(candidates[h].start));
    const double doubt = kHeldDoubt / relative_per_unit(*candidates[h].candidate, size);
    const VectorXd shifts =
        transposed_product(inverse,
                           transposed_product(kept_columns, j.col(static_cast<Index>(h)))) *
        doubt;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto place = static_cast<std::size_t>(kept[i]);
      const double move = shifts[static_cast<Index>(i)];
      const Candidate& candidate = *candidates[place].candidate;
      ParameterJudgement& one = judgement[place];
      one.relative =
          std::hypot(one.relative, move * relative_per_unit(candidate, candidates[place].value));
      one.sigma = std::hypot(one.sigma, move * value_per_unit(candidate, candidates[place].value));
    }
  }
}

/// Holds one more where the doubt of the held makes it unknown: the one of the lowest hold_rank.
void hold_most_doubtful(const std::vector<JudgedCandidate>& candidates, Judgement& judgement) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool is_doubtful =
        judgement[i].verdict == Verdict::kIdentified && judgement[i].relative > kMostRelative;
    if (is_doubtful &&
        (!worst || candidates[i].candidate->hold_rank < candidates[*worst].candidate->hold_rank)) {
      worst = i;
    }
  }
  if (worst) {
    judgement[*worst].verdict = Verdict::kUnidentified;
    judgement[*worst].why = "depends too much on others that are not identified";
  }
}

/// Deviations of the kept. @returns which of them is to be held next, if any
std::optional<std::size_t> deviations(const std::vector<JudgedCandidate>& candidates,
                                      const std::vector<Index>& kept, const MatrixXd& covariance,
                                      Judgement& judgement) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto place = static_cast<std::size_t>(kept[i]);
    const Candidate& candidate = *candidates[place].candidate;
    const auto diagonal = static_cast<Index>(i);
    const double sigma = std::sqrt(covariance(diagonal, diagonal));
    judgement[place].relative = sigma * relative_per_unit(candidate, candidates[place].value);
    judgement[place].sigma = sigma * value_per_unit(candidate, candidates[place].value);
    const auto rank = [&](std::size_t k) {
      return candidates[static_cast<std::size_t>(kept[k])].candidate->hold_rank;
    };
    const double most = candidate.is_analysed_only ? 0.0 : kMostRelative;
    if (judgement[place].relative > most && (!worst || rank(i) < rank(*worst))) {
      worst = i;
    }
  }
  return worst;
}

/// Adds to a covariance the mean square of what rounding shifts the parameters by.
void add_rounding(const MatrixXd& kept_columns, const std::vector<VectorXd>& rounding,
                  MatrixXd& covariance) {
  const MatrixXd inverse = normal_inverse(kept_columns);
  for (const VectorXd& error : rounding) {
    const VectorXd shift = transposed_product(inverse, transposed_product(kept_columns, error));
    covariance.diagonal() += shift.cwiseAbs2() / static_cast<double>(rounding.size());
  }
}

}  // namespace

double value_per_unit(const Candidate& candidate, double value) {
  const Parameter& p = candidate.parameter;
  return p.scale == Scale::kLogarithmic ? value * std::log(p.max / p.min) : p.max - p.min;
}

Judgement judge(const std::vector<JudgedCandidate>& candidates, const Residuals& residuals,
                Eigen::Index block, const std::vector<Eigen::VectorXd>& rounding) {
  Judgement judgement(candidates.size());
  VectorXd x(static_cast<Index>(candidates.size()));
  std::vector<Index> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    x[static_cast<Index>(i)] = candidates[i].unit;
    if (candidates[i].is_held) {
      judgement[i].verdict = Verdict::kUnidentified;
    } else {
      kept.push_back(static_cast<Index>(i));
    }
  }
  const VectorXd residual = residuals(x);
  const MatrixXd j = central_jacobian(residuals, x, kDifference);
  while (!kept.empty()) {
    MatrixXd covariance = block_covariance(columns_of(j, kept), residual, block);
    const auto worst = deviations(candidates, kept, covariance, judgement);
    if (!worst) {
      // Rounding widens deviations, but holds nothing: a held value would shift the others.
      add_rounding(columns_of(j, kept), rounding, covariance);
      deviations(candidates, kept, covariance, judgement);
      break;
    }
    ParameterJudgement& held = judgement[static_cast<std::size_t>(kept[*worst])];
    held.verdict = Verdict::kUnidentified;
    // Positions show a mass as a scale only: whatever its deviation, it is held.
    held.why = candidates[static_cast<std::size_t>(kept[*worst])].candidate->is_analysed_only
                   ? "shows only together with Coulomb friction and all that scales with it"
                   : partners(candidates, kept, normal_inverse(columns_of(j, kept)),
                              static_cast<Index>(*worst));
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(*worst));
  }
  if (!kept.empty()) {
    add_doubt_of_held(candidates, j, kept, judgement);
  }
  for (const Index i : kept) {
    const auto place = static_cast<std::size_t>(i);
    if (is_at_bound(*candidates[place].candidate, candidates[place].unit)) {
      judgement[place].verdict = Verdict::kAtBound;
      judgement[place].why = "best at the end of its range";
    }
  }
  hold_most_doubtful(candidates, judgement);
  return judgement;
}

}  // namespace twin::studies::identify
