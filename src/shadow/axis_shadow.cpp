#include "shadow/axis_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twin::shadow {
namespace {

/// By so much must the logarithm of the likelihood of one cause exceed that of others, twice: odds
/// of 400 to 1 for white noise.
constexpr double kMargin = 12.0;
/// And by this share of what is explained: signatures are of first order.
constexpr double kRelativeMargin = 0.15;
constexpr double kPatience = 1.2;          // of motion, until causes are named that are as good [s]
constexpr double kPatienceForForce = 1.8;  // the same of a force, until a turn has come [s]
constexpr double kLeastTime = 0.5;         // of motion, before any cause is named [s]
constexpr int kLeastBlocks = 3;            // in a row that must name the same cause
constexpr int kLeastTrialBlocks = 8;       // the same where causes are tried, every other block
constexpr std::size_t kMostPoints = 2000;  // of the strip

}  // namespace

AxisShadow::AxisShadow(AxisObserver observer, const std::vector<ChannelBaseline>& baselines,
                       double period, double hours)
    : observer_(std::move(observer)), period_(period) {
  const double block = static_cast<double>(Evidence::kBlock) * period;
  for (const ChannelBaseline& baseline : baselines) {
    const auto at = std::ranges::find(observer_.channels(), baseline.kind);
    if (at == observer_.channels().end()) {
      continue;
    }
    const auto i = static_cast<std::size_t>(at - observer_.channels().begin());
    channels_.push_back({baseline,
                         ChannelFilter(baseline, observer_.facts(i)),
                         Evidence(baseline),
                         threshold_of(hours, block, baseline.windows),
                         {},
                         {},
                         std::nullopt,
                         {},
                         0,
                         i,
                         {},
                         false});
    if (is_followed(baseline.kind)) {
      channels_.back().trials.emplace(baseline, observer_.facts(i), period);
    }
  }
  strip_.reserve(kMostPoints + 1);
}

Finding AxisShadow::judge(const Channel& channel) const {
  const auto by_evidence = channel.evidence.hypotheses();
  const bool is_tried = channel.trials && channel.trials->has_explained();
  auto all = is_tried ? channel.trials->hypotheses() : by_evidence;
  std::ranges::sort(all, std::greater<>(), &Hypothesis::evidence);
  Finding finding;
  finding.cause = all.front();
  finding.statistic = std::ranges::max_element(by_evidence, {}, &Hypothesis::statistic)->statistic;
  finding.threshold = channel.threshold;
  finding.channel = channel.baseline.kind;
  finding.found = now_;
  const auto best = static_cast<std::size_t>(finding.cause.cause);
  const double excess = best < kParameters ? channel.baseline.excess[best] : 1.0;
  const double margin = is_tried
                            ? channel.trials->margin_of(finding.cause)
                            : std::max(kMargin * excess, kRelativeMargin * finding.cause.evidence);
  for (auto other = all.begin() + 1; other != all.end(); ++other) {
    if (other->evidence > 0.0 && finding.cause.evidence - other->evidence < margin) {
      finding.or_else.push_back(other->cause);
    }
  }
  return finding;
}

void AxisShadow::note_level(double level) {
  if (blocks_++ % blocks_a_point_ == 0) {
    strip_.push_back({now_.time, level});
  } else if (!strip_.empty()) {
    strip_.back().level = std::max(strip_.back().level, level);
  }
  if (strip_.size() > kMostPoints) {
    for (std::size_t i = 0; i < kMostPoints / 2; ++i) {
      strip_[i] = {strip_[2 * i].time, std::max(strip_[2 * i].level, strip_[2 * i + 1].level)};
    }
    strip_.resize(kMostPoints / 2);
    blocks_a_point_ *= 2;
  }
}

bool AxisShadow::test(Channel& channel) {
  const auto& block = channel.evidence.blocks().back();
  for (std::size_t i = 0; i < kParameters; ++i) {
    channel.score[i] += block.score[i];
    channel.information[i] += block.information[i];
  }
  const auto all = channel.evidence.hypotheses();
  const double largest = std::ranges::max_element(all, {}, &Hypothesis::statistic)->statistic;
  if (&channel == channels_.data()) {
    note_level(largest / channel.threshold);
  } else if (!strip_.empty()) {
    strip_.back().level = std::max(strip_.back().level, largest / channel.threshold);
  }
  if (finding_ || largest < channel.threshold) {
    return false;
  }
  channel.crossed = channel.crossed ? channel.crossed : now_;
  const double waited = now_.moving - channel.crossed->moving;
  if (channel.trials) {
    channel.trials->explain(all, now_, waited);
    if (!channel.trials->has_explained()) {
      return false;
    }
  }
  Finding finding = judge(channel);
  finding.noticed = *channel.crossed;
  if (channel.trials && finding.cause.evidence < channel.threshold) {
    // The counts themselves do not bear out what their slopes seemed to say.
    if (waited >= kPatience) {
      channel.trials->restart();
      channel.crossed.reset();
      channel.same = 0;
    }
    return false;
  }
  channel.same = finding.cause.cause == channel.favourite ? channel.same + 1 : 1;
  channel.favourite = finding.cause.cause;
  const bool is_jump = channel.favourite == Cause::kForce && finding.channel != ChannelKind::kForce;
  const int least_blocks = channel.trials ? kLeastTrialBlocks : kLeastBlocks;
  const bool is_clear =
      finding.or_else.empty() && !is_jump && channel.same >= least_blocks && waited >= kLeastTime;
  if (!is_clear && waited < (is_jump ? kPatienceForForce : kPatience)) {
    return false;
  }
  found_in_ = static_cast<std::size_t>(&channel - channels_.data());
  finding_ = std::move(finding);
  return true;
}

bool AxisShadow::step(const AxisSample& sample, double time, std::int64_t line) {
  const Observation seen = observer_.step(sample);
  now_.time = time;
  now_.line = line;
  now_.moving += std::ranges::count(seen.moves, true) > 0 ? period_ : 0.0;
  bool is_new = false;
  for (Channel& channel : channels_) {
    if (channel.trials && seen.moves[channel.number]) {
      channel.trials->add({channel.filter.healthy(seen.row[channel.number]), seen.heading,
                           seen.counts, !channel.moved, seen.is_slow});
    }
    channel.moved = seen.moves[channel.number];
    const ChannelFilter::Output output =
        channel.filter.step(seen.row[channel.number], seen.moves[channel.number], seen.direction,
                            seen.heading, seen.is_slow);
    if (output.has_row && channel.evidence.add(output, channel.filter, seen.counts, now_)) {
      is_new = test(channel) || is_new;
    }
  }
  return is_new;
}

std::optional<Finding> AxisShadow::last_finding() const {
  if (!finding_) {
    return std::nullopt;
  }
  Channel channel = channels_[found_in_];
  if (channel.trials) {
    channel.trials->explain(channel.evidence.hypotheses(), now_,
                            now_.moving - channel.crossed->moving);
  }
  Finding last = judge(channel);
  last.found = finding_->found;
  last.noticed = finding_->noticed;
  return last;
}

std::vector<AxisShadow::Estimate> AxisShadow::estimates() const {
  std::vector<Estimate> list;
  for (const Channel& channel : channels_) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      const double information = channel.information[i];
      if (information <= 0.0) {
        continue;
      }
      const double noise = channel.baseline.excess[i] * information;
      const double model = channel.baseline.scatter[i] * information;
      list.push_back({channel.baseline.kind, static_cast<Cause>(i), channel.score[i] / information,
                      std::sqrt(noise + model * model) / information});
    }
  }
  return list;
}

}  // namespace twin::shadow
