#include "shadow/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twin::shadow {
namespace {

constexpr std::size_t kMostBlocks = 256;
/// Tests at the end of a block that are as good as independent: causes of both axes, times begins
/// whose windows share little, one in each factor of two.
constexpr double kTests = 2.0 * kCauses * 8.0;
constexpr double kSmallest = 1e-300;
/// A parameter that is to explain what a force explains, and more, pays this for it: odds of 1 to
/// 400, twice their logarithm.
constexpr double kPriceOfOnset = 12.0;
/// Blocks after which the whitened residual has forgotten what happened at the begin of the first.
constexpr std::size_t kForgotten = kLongestFilter / Evidence::kBlock + 2;

}  // namespace

Evidence::Evidence(const ChannelBaseline& baseline, JumpShapes shapes)
    : baseline_(baseline), jumps_(std::move(shapes), baseline.variance, kBlock) {
  blocks_.reserve(kMostBlocks + 1);
}

void Evidence::interrupt() noexcept { jumps_.reset(); }

bool Evidence::add(const SignalRow& white, double direction, double counts,
                   const Moment& now) noexcept {
  if (in_block_ == 0) {
    open_ = {};
    open_.begin = now;
  }
  double residual = white.residual;
  for (std::size_t i = 0; i < kParameters; ++i) {
    residual -= baseline_.mean[i] * white.signature[i];
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    open_.score[i] += white.signature[i] * residual;
    open_.information[i] += white.signature[i] * white.signature[i];
  }
  open_.passed += counts;
  const JumpFinder::Found found = jumps_.step(residual, direction);
  if (found.counts.gain > 0.0) {
    open_.steps += found.counts.gain;
    open_.lost += found.counts.size;
    open_.events += 1.0;
  }
  if (found.force.gain > open_.force.gain) {
    open_.force = found.force;
  }
  if (++in_block_ < kBlock) {
    return false;
  }
  close();
  return true;
}

void Evidence::close() noexcept {
  in_block_ = 0;
  blocks_.push_back(open_);
  if (blocks_.size() >= kMostBlocks) {
    merge();
  }
}

namespace {

void add_block(const Evidence::Block& other, Evidence::Block& sum) noexcept {
  for (std::size_t p = 0; p < kParameters; ++p) {
    sum.score[p] += other.score[p];
    sum.information[p] += other.information[p];
  }
  sum.steps += other.steps;
  sum.lost += other.lost;
  sum.events += other.events;
  sum.passed += other.passed;
  sum.force = other.force.gain > sum.force.gain ? other.force : sum.force;
}

}  // namespace

/// The older half of the blocks becomes half as many.
void Evidence::merge() noexcept {
  constexpr std::size_t kOld = kMostBlocks / 2;
  for (std::size_t i = 0; i < kOld / 2; ++i) {
    Block sum = blocks_[2 * i];
    add_block(blocks_[2 * i + 1], sum);
    blocks_[i] = sum;
  }
  blocks_.erase(blocks_.begin() + kOld / 2, blocks_.begin() + kOld);
}

void Evidence::judge_parameters(const Block& sum, const Block& begin, const Onset& onset,
                                std::array<Hypothesis, kCauses>& best) const noexcept {
  for (std::size_t i = 0; i < kParameters; ++i) {
    const double information = sum.information[i];
    if (information <= kSmallest) {
      continue;
    }
    const double noise = baseline_.excess[i] * baseline_.variance * information;
    const double model = baseline_.scatter[i] * information;
    const Fitted fit = fitted(sum.score[i], information, baseline_.limit[i]);
    const double statistic = fit.explained * information / (noise + model * model);
    const double evidence = fit.explained / baseline_.variance;
    best[i].statistic = std::max(best[i].statistic, statistic);
    if (evidence + onset.gain > best[i].evidence) {
      best[i].evidence = evidence + onset.gain;
      best[i].change = fit.change;
      best[i].deviation = std::sqrt(noise + model * model) / information;
      best[i].since = onset.gain > 0.0 ? onset.at : begin.begin;
    }
  }
}

void Evidence::judge_jumps(const Block& sum, const Block& begin,
                           std::array<Hypothesis, kCauses>& best) const noexcept {
  Hypothesis& encoder = best[static_cast<std::size_t>(Cause::kEncoder)];
  const double counted = sum.steps / baseline_.step_excess;
  if (begin.steps > 0.0 && counted > encoder.statistic) {
    encoder.statistic = counted;
    encoder.evidence = sum.steps;
    encoder.change = sum.lost / std::max(sum.passed, 1.0);
    encoder.deviation = encoder.change / std::sqrt(sum.events);
    encoder.since = begin.begin;
  }
  Hypothesis& force = best[static_cast<std::size_t>(Cause::kForce)];
  const double forced = begin.force.gain / baseline_.force_excess;
  if (forced > force.statistic) {
    force.statistic = forced;
    force.evidence = begin.force.gain;
    force.change = begin.force.size;
    force.deviation = std::abs(begin.force.size) / std::sqrt(begin.force.gain);
    force.since = begin.begin;
  }
}

std::array<Hypothesis, kCauses> Evidence::hypotheses() const noexcept {
  std::array<Hypothesis, kCauses> best{};
  for (std::size_t i = 0; i < kCauses; ++i) {
    best[i].cause = static_cast<Cause>(i);
  }
  Block sum;
  for (std::size_t i = blocks_.size(); i-- > 0;) {
    const Block& block = blocks_[i];
    add_block(block, sum);
    judge_parameters(sum, block, {}, best);
    if (i >= kForgotten && blocks_[i - kForgotten].force.gain > kPriceOfOnset) {
      const Block& before = blocks_[i - kForgotten];
      judge_parameters(sum, block, {before.force.gain - kPriceOfOnset, before.begin}, best);
    }
    judge_jumps(sum, block, best);
  }
  return best;
}

double threshold_of(double hours, double block, std::size_t windows) noexcept {
  const double tests = hours * 3600.0 / block * kTests;
  const double log_p = -std::log(tests);
  // P(chi^2 > h) = erfc(sqrt(h / 2)), inverted by bisection of its logarithm.
  double low = 1.0;
  double high = 600.0;
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (low + high);
    (std::log(std::erfc(std::sqrt(0.5 * h))) > log_p ? low : high) = h;
  }
  if (windows == 0) {
    return low;
  }
  const auto n = static_cast<double>(windows);
  return n * std::expm1(low / (n + 1.0));
}

}  // namespace twin::shadow
