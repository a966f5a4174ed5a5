#include "shadow/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twin::shadow {
namespace {

/// Tests at the end of a block that are as good as independent: causes of both axes, times begins
/// whose windows share little, one in each factor of two.
constexpr double kTests = 2.0 * kCauses * 8.0;
constexpr double kSmallest = 1e-300;
/// Share of a parameter's information that must be left beside a force.
constexpr double kApart = 1e-3;
/// Nobody knows the period in which a force began, so it pays 2 ln of those that a block has.
const double kPriceOfTime = 2.0 * std::log(static_cast<double>(Evidence::kBlock));
/// A parameter that is to explain what a force explains, and more, pays this for it: odds of 1 to
/// 400, twice their logarithm.
constexpr double kPriceOfOnset = 12.0;
/// Blocks after which the whitened residual has forgotten what happened at the begin of the first.
constexpr std::size_t kForgotten = kLongestFilter / Evidence::kBlock + 2;

}  // namespace

Evidence::Evidence(const ChannelBaseline& baseline, std::size_t most_blocks)
    : baseline_(baseline), most_blocks_(most_blocks) {
  blocks_.reserve(most_blocks + 1);
}

bool Evidence::add(const ChannelFilter::Output& output, const ChannelFilter& filter, double counts,
                   const Moment& now) noexcept {
  if (in_block_ == 0) {
    open_ = {};
    open_.begin = now;
  }
  const WhiteRow& row = output.row;
  for (std::size_t i = 0; i < kParameters; ++i) {
    open_.score[i] += row.signature[i] * row.score;
    open_.information[i] += row.weight * row.signature[i] * row.signature[i];
  }
  open_.passed += counts;
  if (output.jumps.counts.gain > 0.0) {
    open_.steps += output.jumps.counts.gain;
    open_.lost += output.jumps.counts.size;
    open_.events += 1.0;
  }
  if (output.jumps.force.gain > open_.force.gain) {
    open_.force = output.jumps.force;
  }
  if (++in_block_ < kBlock) {
    return false;
  }
  close(filter.onsets());
  return true;
}

void Evidence::close(const OnsetBank* onsets) noexcept {
  in_block_ = 0;
  blocks_.push_back(open_);
  for (std::size_t i = 0; onsets != nullptr && i < OnsetBank::kLasts / kBlock; ++i) {
    if (i >= blocks_.size()) {
      break;
    }
    const Onset best = onsets->best(i * kBlock, kBlock);
    Block& block = blocks_[blocks_.size() - 1 - i];
    if (best.explained() > block.onset.explained()) {
      block.onset = best;
      block.force = {best.explained() - kPriceOfTime, best.score / best.information};
    }
  }
  if (blocks_.size() >= most_blocks_) {
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
  if (other.force.gain > sum.force.gain) {
    sum.force = other.force;
    sum.onset = other.onset;
  }
}

}  // namespace

/// The older half of the blocks becomes half as many.
void Evidence::merge() noexcept {
  const std::size_t old = most_blocks_ / 2;
  for (std::size_t i = 0; i < old / 2; ++i) {
    Block sum = blocks_[2 * i];
    add_block(blocks_[2 * i + 1], sum);
    blocks_[i] = sum;
  }
  const auto first = blocks_.begin();
  blocks_.erase(first + static_cast<std::ptrdiff_t>(old / 2),
                first + static_cast<std::ptrdiff_t>(old / 2 * 2));
}

void Evidence::judge_parameters(const Block& sum, const Block& begin, double gain,
                                std::array<Hypothesis, kCauses>& best) const noexcept {
  for (std::size_t i = 0; i < kParameters; ++i) {
    const double information = sum.information[i];
    if (information <= kSmallest) {
      continue;
    }
    const double noise = baseline_.excess[i] * information;
    const double model = baseline_.scatter[i] * information;
    const double variance = noise + model * model;
    const Fitted fit = fitted(sum.score[i], information, baseline_.limit[i]);
    best[i].statistic = std::max(best[i].statistic, fit.explained * information / variance);
    if (fit.explained + gain > best[i].evidence) {
      best[i].evidence = fit.explained + gain;
      best[i].change = fit.change;
      best[i].deviation = std::sqrt(variance) / information;
      best[i].since = begin.begin;
    }
  }
}

/// Takes the force that began off the scores of the parameters.
Evidence::Block Evidence::without_onset(Block sum, const Onset& onset) noexcept {
  for (std::size_t i = 0; i < kParameters; ++i) {
    const double share = onset.cross[i] / onset.information;
    const double left = sum.information[i] - share * onset.cross[i];
    // What the two have in common to rounding says nothing of the parameter.
    const bool is_apart = left > kApart * sum.information[i];
    sum.score[i] = is_apart ? sum.score[i] - share * onset.score : 0.0;
    sum.information[i] = is_apart ? left : 0.0;
  }
  return sum;
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
    judge_parameters(sum, block, 0.0, best);
    if (block.onset.information > 0.0) {
      if (block.force.gain > kPriceOfOnset) {
        judge_parameters(without_onset(sum, block.onset), block, block.force.gain - kPriceOfOnset,
                         best);
      }
    } else if (i >= kForgotten && blocks_[i - kForgotten].force.gain > kPriceOfOnset) {
      const Block& before = blocks_[i - kForgotten];
      judge_parameters(sum, before, before.force.gain - kPriceOfOnset, best);
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
