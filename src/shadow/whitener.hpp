#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shadow/jump_finder.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// Makes white noise of a channel's residual by an autoregressive filter, and passes the signatures
/// through the same filter.
///
/// With d_k = r_k - r_(k-1), or d_k = r_k where nothing is differenced, and coefficients a_j,
///   e_k = d_k - sum_j a_j d_(k-j),   j = 1 .. p.
/// The filter is linear and forgets after p periods. So a residual that a change of parameters makes,
/// r = sum theta_i s_i, becomes e = noise + sum theta_i z_i with z the filtered signatures, and a
/// level from before the change is forgotten.
class Whitener {
 public:
  /// @param coefficients  a_1 .. a_p  @param is_differenced  d is an increment. Allocates.
  Whitener(std::span<const double> coefficients, bool is_differenced);

  /// Forgets the past. Real-time safe.
  void reset() noexcept;
  /// Takes a row. Real-time safe.
  /// @returns whether `white` is made of a full past
  bool step(const SignalRow& raw, SignalRow& white) noexcept;

  std::size_t order() const noexcept { return coefficients_.size(); }

 private:
  std::vector<double> coefficients_;
  bool is_differenced_;
  std::vector<SignalRow> past_;  // increments, a ring of p rows, each written twice
  std::size_t next_ = 0;
  std::size_t rows_ = 0;
  SignalRow last_;
};

/// What steps of counts and of force leave behind a whitener, until it has forgotten them.
/// @param count  step of the residual by a count; 0: there are none
/// @param force_response  of the residual to 1 N, period by period; may be empty
JumpShapes shapes_of(const Whitener& whitener, double count,
                     const std::vector<double>& force_response);

/// Coefficients of an autoregressive model of order p by Levinson's recursion.
/// @param covariance  autocovariance at lags 0 .. p
std::vector<double> autoregression(std::span<const double> covariance);

}  // namespace twin::shadow
