#include "shadow/count_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace twin::shadow {
namespace {

/// Deviation of the hum that the model has wrong, at first, in counts; and its walk in that of the
/// level.
constexpr double kHum = 0.1;
constexpr double kHumWalk = 0.1;
/// Deviation of the level at first, in counts.
constexpr double kUnknown = 1.0;
/// Odds, as logarithms, at which a jump is taken for one, and against which it is given up.
constexpr double kSureJump = 20.0;
constexpr double kGivenUp = -20.0;
/// Beyond so many deviations the tail of the normal distribution is taken by its expansion.
constexpr double kTail = 6.0;

double density(double x) noexcept {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

/// ln (Phi(b) - Phi(a)) with its first and second derivatives by a common shift -m of both, where
/// deviations are 1.
struct Interval {
  double log = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

Interval between(double a, double b) noexcept {
  const bool is_above = a > kTail;
  const bool is_below = b < -kTail;
  if (is_above || is_below) {
    const double x = is_above ? a : -b;  // 1 - Phi(x) = density(x) / x (1 - 1 / x^2 ...)
    const double inverse = 1.0 / (x * x);
    const double slope = x * (1.0 + inverse - 2.0 * inverse * inverse);
    return {-0.5 * x * x - std::log(x * std::sqrt(2.0 * std::numbers::pi)),
            is_above ? slope : -slope, 1.0 - inverse};
  }
  const double root = std::numbers::sqrt2;
  // From the side where both are small, so that the difference keeps its digits.
  const double share = a > 0.0 ? 0.5 * (std::erfc(a / root) - std::erfc(b / root))
                               : 0.5 * (std::erfc(-b / root) - std::erfc(-a / root));
  const double z = std::max(share, 1e-300);
  const double slope = (density(a) - density(b)) / z;
  const double curvature = slope * slope + (b * density(b) - a * density(a)) / z;
  return {std::log(z), slope, std::clamp(curvature, 0.0, 1.0)};  // but for rounding
}

}  // namespace

CountFilter::CountFilter(double count, CountNoise noise, double hum_angle,
                         std::size_t signatures) noexcept
    : count_(count), noise_(noise), hum_angle_(hum_angle), signatures_(signatures) {}

void CountFilter::interrupt() noexcept {
  has_begun_ = false;
  filled_ = 0;
  jump_ = 0.0;
}

void CountFilter::begin(const SignalRow& raw) noexcept {
  has_begun_ = true;
  main_ = {};
  main_.mean[0] = raw.residual;
  main_.covariance[0][0] = kUnknown * kUnknown * count_ * count_;
  if (hum_angle_ != 0.0) {
    main_.covariance[1][1] = main_.covariance[2][2] = kHum * kHum * count_ * count_;
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    signature_[i] = {raw.signature[i], 0.0, 0.0};
  }
}

CountFilter::Slope CountFilter::take(double residual, const State& observed, double loose,
                                     Follower& follower, State& gain) const noexcept {
  const double walk = noise_.walk * noise_.walk;
  follower.covariance[0][0] += walk + loose * loose;
  if (hum_angle_ != 0.0) {
    follower.covariance[1][1] += kHumWalk * kHumWalk * walk;
    follower.covariance[2][2] += kHumWalk * kHumWalk * walk;
  }
  State with_level{};  // P H'
  double mean = 0.0;
  double variance = noise_.white * noise_.white;
  for (std::size_t i = 0; i < kStates; ++i) {
    mean += observed[i] * follower.mean[i];
    for (std::size_t j = 0; j < kStates; ++j) {
      with_level[i] += follower.covariance[i][j] * observed[j];
    }
  }
  for (std::size_t i = 0; i < kStates; ++i) {
    variance += observed[i] * with_level[i];
  }
  const double deviation = std::sqrt(variance);
  const double edge = 0.5 * count_;
  const Interval seen =
      between((residual - edge - mean) / deviation, (residual + edge - mean) / deviation);
  const Slope slope{seen.slope / deviation, seen.curvature / variance, seen.log};
  for (std::size_t i = 0; i < kStates; ++i) {
    follower.mean[i] += with_level[i] * slope.score;
    gain[i] = with_level[i] * slope.weight;
    for (std::size_t j = 0; j < kStates; ++j) {
      follower.covariance[i][j] -= with_level[i] * slope.weight * with_level[j];
    }
  }
  return slope;
}

/// Of all levels by whole counts from the mean, the one within the counts that are read.
void CountFilter::suppose_jump(double residual, const State& observed, const Follower& before,
                               double main, double direction) noexcept {
  double mean = 0.0;
  for (std::size_t j = 0; j < kStates; ++j) {
    mean += observed[j] * before.mean[j];
  }
  jump_ = std::round((residual - mean) / count_);
  if (jump_ == 0.0) {
    return;
  }
  is_loss_ = jump_ * direction < 0.0;
  age_ = 0;
  other_ = before;
  other_.mean[0] += jump_ * count_;
  State unused{};
  odds_ = take(residual, observed, 0.0, other_, unused).log_likelihood - main;
}

void CountFilter::follow_jump(double residual, const State& observed, double main,
                              Step& step) noexcept {
  State unused{};
  odds_ += take(residual, observed, 0.0, other_, unused).log_likelihood - main;
  ++age_;
  if (odds_ < kGivenUp) {
    jump_ = 0.0;
  } else if (age_ >= kDelay) {
    if (odds_ > kSureJump && is_loss_) {
      main_ = other_;
      step.jump = jump_;
      step.gain = 2.0 * odds_;
      for (Row& row : rows_) {  // all of them are younger than the jump
        row.white.score = row.white.weight = 0.0;
        row.gain = {};
      }
    }
    jump_ = 0.0;
  }
}

CountFilter::Step CountFilter::step(const SignalRow& raw, double direction, double loose) noexcept {
  phase_ = std::fmod(phase_ + hum_angle_, 2.0 * std::numbers::pi);
  const bool begins = !has_begun_;
  if (begins) {
    begin(raw);
  }
  const State observed{1.0, hum_angle_ != 0.0 ? std::cos(phase_) : 0.0,
                       hum_angle_ != 0.0 ? std::sin(phase_) : 0.0};
  const Follower before = main_;
  Row& row = rows_[next_];
  row.observed = observed;
  row.has_begun = begins;
  const Slope slope = take(raw.residual, observed, loose, main_, row.gain);
  row.white.score = slope.score;
  row.white.weight = slope.weight;
  for (std::size_t i = 0; i < signatures_; ++i) {
    double expected = 0.0;
    for (std::size_t j = 0; j < kStates; ++j) {
      expected += observed[j] * signature_[i][j];
    }
    row.white.signature[i] = raw.signature[i] - expected;
    for (std::size_t j = 0; j < kStates; ++j) {
      signature_[i][j] += row.gain[j] * row.white.signature[i];
    }
  }
  next_ = next_ == kDelay ? 0 : next_ + 1;
  filled_ = std::min(filled_ + 1, kDelay + 1);
  Step result;
  result.log_likelihood = slope.log_likelihood;
  if (jump_ != 0.0) {
    follow_jump(raw.residual, observed, slope.log_likelihood, result);
  } else {
    suppose_jump(raw.residual, observed, before, slope.log_likelihood, direction);
  }
  if (filled_ == kDelay + 1) {
    result.row = &rows_[next_];
  }
  return result;
}

}  // namespace twin::shadow
