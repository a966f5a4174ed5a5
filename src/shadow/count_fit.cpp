#include "shadow/count_fit.hpp"

#include <algorithm>
#include <cmath>

namespace twin::shadow {
namespace {

/// Periods before a change from which on a filter runs, so that it knows the level at the change.
constexpr std::size_t kRunUp = 300;
constexpr std::size_t kForceIndex = static_cast<std::size_t>(Cause::kForce);
constexpr std::size_t kEncoderIndex = static_cast<std::size_t>(Cause::kEncoder);
constexpr int kImprovements = 3;
constexpr int kHalvings = 3;        // of a step that makes it worse
constexpr double kLeastGain = 0.5;  // of a likelihood's logarithm that is worth another step
/// What grows must explain so much more than what changes at once: odds of 400 to 1.
constexpr double kPriceOfGrowth = 12.0;
/// What each lost count pays for its time: 2 ln of the periods of a block.
constexpr double kPriceOfLoss = 8.0;

}  // namespace

CountHistory::CountHistory() : periods_(kBefore + kAfter) {}

void CountHistory::add(const Period& period) noexcept {
  if (is_full()) {
    return;
  }
  kept_ += is_kept_ ? 1 : 0;
  periods_[end_ % periods_.size()] = period;
  ++end_;
  size_ = std::min(size_ + 1, is_kept_ ? periods_.size() : kBefore);
}

struct CountFit::Sums {
  double log_likelihood = 0.0;
  std::array<double, 2> score{};  // of theta and F
  double theta = 0.0;             // informations
  double both = 0.0;
  double force = 0.0;
};

CountFit::CountFit(const ChannelBaseline& baseline, const ChannelFacts& facts, double period)
    : baseline_(baseline), facts_(facts), period_(period) {
  const std::vector<double>& response = facts_.force_response;
  for (std::size_t k = 0; k < response.size(); ++k) {
    const double before = k == 0 ? 0.0 : response[k - 1];
    response_step_.push_back(std::abs(response[std::min(k + 1, response.size() - 1)] - before));
  }
}

CountFit::Sums CountFit::pass(const CountHistory& history, std::size_t begin, std::size_t cause,
                              Course course, const Trial& trial) const {
  CountFilter filter(facts_.count, baseline_.noise, facts_.hum_angle, 2);
  Sums sums;
  const bool has_change = cause < kParameters && cause != kForceIndex;
  const bool grows = course == Course::kGrowing;
  const double start = has_change ? history[begin].row.signature[cause] : 0.0;
  const std::size_t first = std::max(history.first() + kRunUp, begin) - kRunUp;
  for (std::size_t k = first; k < history.end(); ++k) {
    const CountHistory::Period& period = history[k];
    if (period.begins) {
      filter.interrupt();
    }
    SignalRow row;
    row.residual = period.row.residual;
    double loose = 0.0;
    if (k >= begin) {
      const std::size_t age = std::min(k - begin, facts_.force_response.size() - 1);
      const double shape = has_change ? period.row.signature[cause] : 0.0;
      row.signature[0] = grows        ? shape * static_cast<double>(k - begin) * period_
                         : has_change ? shape - start
                                      : 0.0;
      row.signature[1] = grows ? shape - start : facts_.force_response[age];
      row.residual -= trial.change * row.signature[0] + trial.beside * row.signature[1];
      loose = trial.is_none || grows ? 0.0 : onset_ * response_step_[age];
    }
    const CountFilter::Step step =
        filter.step(row, 0.0, std::hypot(loose, period.is_slow ? baseline_.noise.slow : 0.0));
    sums.log_likelihood += k >= begin ? step.log_likelihood : 0.0;
    if (step.row != nullptr) {
      const WhiteRow& white = step.row->white;
      const double theta = white.signature[0];
      const double force = white.signature[1];
      sums.score[0] += white.score * theta;
      sums.score[1] += white.score * force;
      sums.theta += white.weight * theta * theta;
      sums.both += white.weight * theta * force;
      sums.force += white.weight * force * force;
    }
  }
  return sums;
}

namespace {

/// The step of theta and F by slopes and curvatures.
std::array<double, 2> step_of(const std::array<double, 2>& score, double theta, double both,
                              double force) {
  const double det = theta * force - both * both;
  if (det > 1e-6 * theta * force) {
    return {(force * score[0] - both * score[1]) / det, (theta * score[1] - both * score[0]) / det};
  }
  return {force > 0.0 || theta <= 0.0 ? 0.0 : score[0] / theta,
          force > 0.0 ? score[1] / force : 0.0};
}

}  // namespace

CountFit::Trial CountFit::improved(const CountHistory& history, std::size_t begin,
                                   std::size_t cause, Course course, double nothing,
                                   Trial trial) const {
  const double limit = cause < kParameters ? baseline_.limit[cause] : 0.0;
  Sums here = pass(history, begin, cause, course, trial);
  for (int round = 0; round < kImprovements; ++round) {
    auto [change, force] = step_of(here.score, here.theta, here.both, here.force);
    double gained = 0.0;
    for (int halving = 0; halving <= kHalvings && gained <= 0.0; ++halving) {
      Trial tried = trial;
      tried.change = std::clamp(trial.change + change, -limit, limit);
      tried.beside = trial.beside + force;
      const Sums there = pass(history, begin, cause, course, tried);
      gained = there.log_likelihood - here.log_likelihood;
      if (gained > 0.0) {
        trial = tried;
        here = there;
      }
      change *= 0.5;
      force *= 0.5;
    }
    if (gained < kLeastGain) {
      break;
    }
  }
  trial.explained = 2.0 * (here.log_likelihood - nothing);
  trial.information = cause == kForceIndex ? here.force
                      : here.force > 0.0   ? here.theta - here.both * here.both / here.force
                                           : here.theta;
  return trial;
}

/// The same of lost counts.
void CountFit::count(const CountHistory& history, std::size_t begin, double nothing) {
  CountFilter filter(facts_.count, baseline_.noise, facts_.hum_angle, 0);
  const std::size_t first = std::max(history.first() + kRunUp, begin) - kRunUp;
  double sum = 0.0;
  lost_ = events_ = passed_ = 0.0;
  for (std::size_t k = first; k < history.end(); ++k) {
    const CountHistory::Period& period = history[k];
    if (period.begins) {
      filter.interrupt();
    }
    const CountFilter::Step step =
        filter.step(period.row, period.direction, period.is_slow ? baseline_.noise.slow : 0.0);
    if (k < begin) {
      continue;
    }
    sum += step.log_likelihood + 0.5 * step.gain;
    if (step.jump != 0.0) {
      events_ += 1.0;
      lost_ += std::abs(step.jump);
    }
    passed_ += period.counts;
  }
  at_once_[kEncoderIndex].explained = 2.0 * (sum - nothing) - kPriceOfLoss * events_;
  at_once_[kEncoderIndex].change = lost_ / std::max(passed_, 1.0);
}

namespace {

bool has_signature(const CountHistory& history, std::size_t begin, std::size_t cause) {
  for (std::size_t k = begin; k < history.end(); ++k) {
    if (history[k].row.signature[cause] != 0.0) {
      return true;
    }
  }
  return false;
}

}  // namespace

void CountFit::explain(const CountHistory& history, std::size_t begin) {
  Trial none;
  none.is_none = true;
  const double nothing = pass(history, begin, kForceIndex, Course::kAtOnce, none).log_likelihood;
  seconds_ = period_ * static_cast<double>(history.end() - begin);
  for (std::size_t i = 0; i < kParameters; ++i) {
    const bool is_force = i == kForceIndex;
    if (!is_force && !has_signature(history, begin, i)) {
      continue;
    }
    at_once_[i] = improved(history, begin, i, Course::kAtOnce, nothing, at_once_[i]);
    if (!is_force) {
      growing_[i] = improved(history, begin, i, Course::kGrowing, nothing, growing_[i]);
    }
  }
  // A force alone is what each of them can be with no change: none may find a better one.
  Trial& alone = at_once_[kForceIndex];
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (i == kForceIndex || at_once_[i].explained <= alone.explained) {
      continue;
    }
    Trial trial;
    trial.beside = at_once_[i].beside;
    trial = improved(history, begin, kForceIndex, Course::kAtOnce, nothing, trial);
    alone = trial.explained > alone.explained ? trial : alone;
  }
  count(history, begin, nothing);
}

CountFit::Trial CountFit::best(std::size_t cause) const noexcept {
  if (growing_[cause].explained <= at_once_[cause].explained + kPriceOfGrowth) {
    return at_once_[cause];
  }
  Trial trial = growing_[cause];
  trial.explained -= kPriceOfGrowth;
  trial.change = trial.beside + trial.change * seconds_;
  trial.beside = 0.0;
  trial.information /= seconds_ * seconds_;
  return trial;
}

std::size_t CountFit::refine(const CountHistory& history, std::size_t begin, std::size_t range) {
  const std::size_t low = std::max(begin, history.first() + range) - range;
  const std::size_t high = std::min(begin + range, history.end() - 1);
  std::size_t best = begin;
  Trial trial;
  Trial none;
  none.is_none = true;
  double largest = 0.0;
  for (std::size_t k = low; k <= high; k += 2) {
    // Likelihoods since different times: against that without a force.
    const double nothing = pass(history, k, kForceIndex, Course::kAtOnce, none).log_likelihood;
    const Trial here = improved(history, k, kForceIndex, Course::kAtOnce, nothing, trial);
    if (k == low || here.explained > largest) {
      largest = here.explained;
      best = k;
      trial = here;
    }
  }
  onset_ = std::abs(trial.beside);
  for (Trial& one : at_once_) {
    one.beside = trial.beside;
  }
  return best;
}

}  // namespace twin::shadow
