#include "shadow/channel_filter.hpp"

#include <cmath>

#include "shadow/evidence.hpp"

namespace twin::shadow {
namespace {

/// Nobody knows the period of a jump, so each pays 2 ln of those that a block has.
const double kPriceOfPeriod = 2.0 * std::log(static_cast<double>(Evidence::kBlock));

}  // namespace

ChannelFilter::ChannelFilter(const ChannelBaseline& baseline, const ChannelFacts& facts)
    : mean_(baseline.mean), variance_(baseline.variance), slow_(baseline.noise.slow) {
  if (is_followed(baseline.kind)) {
    counts_.emplace(facts.count, baseline.noise, facts.hum_angle);
    if (facts.force_response.size() >= OnsetBank::kLasts) {
      onsets_.emplace(facts.force_response);
    }
  } else {
    whitener_.emplace(baseline.coefficients, is_differenced(baseline.kind));
    jumps_.emplace(shapes_of(*whitener_, facts.count, facts.force_response), variance_,
                   Evidence::kBlock);
  }
}

SignalRow ChannelFilter::healthy(SignalRow raw) const noexcept {
  for (std::size_t i = 0; i < kParameters; ++i) {
    raw.residual -= mean_[i] * raw.signature[i];
  }
  return raw;
}

ChannelFilter::Output ChannelFilter::step(const SignalRow& raw, bool moves, double direction,
                                          double heading, bool is_slow) noexcept {
  Output output;
  const SignalRow row = healthy(raw);
  if (counts_) {
    if (!moves) {
      counts_->interrupt();
      return output;
    }
    const CountFilter::Step step = counts_->step(row, heading, is_slow ? slow_ : 0.0);
    if (step.jump != 0.0) {
      output.jumps.counts = {step.gain - kPriceOfPeriod, std::abs(step.jump)};
    }
    if (step.row != nullptr) {
      output.has_row = true;
      output.row = step.row->white;
      if (onsets_) {
        onsets_->step(*step.row);
      }
    }
    return output;
  }
  SignalRow white;
  if (!whitener_->step(row, white) || !moves) {
    jumps_->reset();
    return output;
  }
  output.has_row = true;
  output.row = {white.residual / variance_, 1.0 / variance_, white.signature};
  output.jumps = jumps_->step(white.residual, direction);
  return output;
}

}  // namespace twin::shadow
