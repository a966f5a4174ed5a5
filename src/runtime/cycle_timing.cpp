#include "runtime/cycle_timing.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace twin::runtime {
namespace {

results::TimeStats figures_of(const results::LogHistogram& times) {
  return {times.quantile(0.5), times.quantile(0.99), times.quantile(0.999), times.max()};
}

}  // namespace

void CycleTiming::add(const results::Sample& sample) noexcept {
  wake_up_.add(sample.wake_up_latency);
  compute_.add(sample.cycle_time);
  total_.add(sample.total_time);
}

results::RealTimeStats CycleTiming::figures() const {
  results::RealTimeStats figures;
  figures.wake_up = figures_of(wake_up_);
  figures.compute = figures_of(compute_);
  figures.total = figures_of(total_);
  return figures;
}

std::string CycleTiming::to_csv() const {
  const auto any = [&](std::size_t k) {
    return wake_up_.count_in(k) + compute_.count_in(k) + total_.count_in(k) > 0;
  };
  std::size_t first = 0;
  std::size_t last = results::LogHistogram::kBins;
  while (first < last && !any(first)) {
    ++first;
  }
  while (last > first && !any(last - 1)) {
    --last;
  }
  std::string text = "time_us,wake_up,compute,total\n";
  for (std::size_t k = first; k < last; ++k) {
    text += fmt::format("{:.6g},{},{},{}\n", results::LogHistogram::lower_end(k) * 1e6,
                        wake_up_.count_in(k), compute_.count_in(k), total_.count_in(k));
  }
  return text;
}

}  // namespace twin::runtime
