#pragma once

#include <string>
#include <vector>

#include "studies/identify/axis_fit.hpp"
#include "studies/identify/least_squares.hpp"

namespace twin::studies::identify {

/// A parameter with a larger relative standard deviation counts as not shown by the data.
inline constexpr double kMostRelative = 0.25;

/// What the data say of one parameter.
struct ParameterJudgement {
  Verdict verdict = Verdict::kIdentified;
  double sigma = 0.0;     ///< standard deviation, in the key's unit
  double relative = 0.0;  ///< of the value, or of its natural size
  std::string why;        ///< where it is not identified
};
using Judgement = std::vector<ParameterJudgement>;

/// A candidate at the fit.
struct JudgedCandidate {
  const Candidate* candidate = nullptr;
  double value = 0.0;    ///< in the key's unit
  double unit = 0.0;     ///< place in its range, 0 to 1
  double start = 0.0;    ///< its starting value, in the key's unit
  bool is_held = false;  ///< known to be unidentified
};

/// What moving a candidate through its whole range changes its value by, to first order [its unit].
double value_per_unit(const Candidate& candidate, double value);

/// Tells identified from unidentified parameters at a least-squares fit.
///
/// The derivatives J at the fit and the residuals give a covariance. While the relative standard
/// deviation of some parameters exceeds kMostRelative, the one of them with the lowest hold_rank is
/// held, that is, its column of J is dropped. Some parameters show only together, as do the mass and
/// all frictions that scale with it; one of these is held and the others are determined relative to
/// it. The deviations that are reported include a doubt of 30 % of each held value, propagated to
/// first order, and what the rounding to counts shifts the parameters by.
/// @param block     rows within which residuals may be correlated
/// @param rounding  what rounding makes of the residuals, in several cases; may be empty
Judgement judge(const std::vector<JudgedCandidate>& candidates, const Residuals& residuals,
                Eigen::Index block, const std::vector<Eigen::VectorXd>& rounding = {});

}  // namespace twin::studies::identify
