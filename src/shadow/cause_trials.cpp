#include "shadow/cause_trials.hpp"

#include <algorithm>
#include <cmath>

namespace twin::shadow {
namespace {

/// From so long after something was noticed on it is explained [s].
constexpr double kFirstTrial = 0.35;
/// Periods until it is explained again with those that came since.
constexpr std::size_t kBetweenTrials = 100;
/// A cause that adds to what a force explains pays this: odds of 1 to 400, twice their logarithm. It
/// must lead by as much, and by this share of what it adds: signatures are of first order.
constexpr double kPriceOfCause = 12.0;
constexpr double kShareOfLead = 0.25;
/// A force that gains so much has begun where it seems to.
constexpr double kClearForce = 12.0;
constexpr std::size_t kForceAt = static_cast<std::size_t>(Cause::kForce);
constexpr std::size_t kEncoderAt = static_cast<std::size_t>(Cause::kEncoder);

}  // namespace

CauseTrials::CauseTrials(const ChannelBaseline& baseline, const ChannelFacts& facts, double period)
    : baseline_(baseline), period_(period), fit_(baseline, facts, period) {}

void CauseTrials::explain(const std::array<Hypothesis, kCauses>& by_evidence, const Moment& now,
                          double waited) {
  history_.keep();
  const std::size_t new_periods = history_.end() - explained_to_;
  if (waited < kFirstTrial || (explained_to_ > 0 && new_periods < kBetweenTrials)) {
    return;
  }
  if (!has_begun_) {
    has_begun_ = true;
    const bool is_force = by_evidence[kForceAt].evidence > kClearForce;
    since_ = is_force ? by_evidence[kForceAt].since
                      : std::ranges::max_element(by_evidence, {}, &Hypothesis::statistic)->since;
    const auto ago = static_cast<std::size_t>(std::lround((now.moving - since_.moving) / period_)) +
                     CountFilter::kDelay;
    const std::size_t least = history_.first() + 1;
    begin_ = std::max(history_.end(), least + ago) - ago;
    if (is_force) {
      constexpr std::size_t kHalf = Evidence::kBlock / 2;
      const std::size_t about = std::min(begin_ + kHalf, history_.end() - 1);
      begin_ = fit_.refine(history_, about, kHalf + OnsetBank::kEvery);
    }
  }
  fit_.explain(history_, begin_);
  explained_to_ = history_.end();
}

void CauseTrials::restart() noexcept {
  history_.release();
  fit_.reset();
  has_begun_ = false;
  explained_to_ = 0;
}

std::array<Hypothesis, kCauses> CauseTrials::hypotheses() const noexcept {
  std::array<Hypothesis, kCauses> all{};
  for (std::size_t i = 0; i < kCauses; ++i) {
    const CountFit::Trial trial = fit_.best(i);
    Hypothesis& one = all[i];
    one.cause = static_cast<Cause>(i);
    one.since = since_;
    one.change = i == kForceAt ? trial.beside : trial.change;
    one.evidence = trial.explained - (i == kForceAt || i == kEncoderAt ? 0.0 : kPriceOfCause);
    if (i == kEncoderAt) {
      one.deviation = one.change / std::sqrt(std::max(fit_.events(), 1.0));
    } else if (i < kParameters && trial.information > 0.0) {
      const double model = baseline_.scatter[i] * trial.information;
      one.deviation =
          std::sqrt(baseline_.excess[i] * trial.information + model * model) / trial.information;
    }
  }
  return all;
}

double CauseTrials::margin_of(const Hypothesis& best) const noexcept {
  const auto i = static_cast<std::size_t>(best.cause);
  const double excess = i < kParameters ? baseline_.excess[i] : 1.0;
  const double added = best.evidence - fit_.best(kForceAt).explained;
  return std::max(kPriceOfCause * excess, kShareOfLead * added);
}

}  // namespace twin::shadow
