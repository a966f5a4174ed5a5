#include "tests/fuzz/random_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace twin::fuzz {
namespace {

constexpr std::size_t kShownBreaches = 20;

double quantile(const std::vector<float>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

void RandomStatistics::add(std::uint64_t number, const Outcome& outcome) {
  ++programs_;
  ++endings_[outcome.ending];
  set_points_ += outcome.set_points;
  for (std::size_t i = 0; i < kMeasures; ++i) {
    if (!std::isnan(outcome.shares[i])) {
      shares_[i].push_back(static_cast<float>(outcome.shares[i]));
    }
  }
  known_ += outcome.findings.empty() && !outcome.known.empty() ? 1 : 0;
  if (!outcome.findings.empty()) {
    breaches_.push_back({number, outcome.findings});
  }
}

void RandomStatistics::add(const RandomStatistics& other) {
  programs_ += other.programs_;
  set_points_ += other.set_points_;
  known_ += other.known_;
  for (const auto& [ending, count] : other.endings_) {
    endings_[ending] += count;
  }
  for (std::size_t i = 0; i < kMeasures; ++i) {
    shares_[i].insert(shares_[i].end(), other.shares_[i].begin(), other.shares_[i].end());
  }
  breaches_.insert(breaches_.end(), other.breaches_.begin(), other.breaches_.end());
  std::sort(breaches_.begin(), breaches_.end(),
            [](const Breach& a, const Breach& b) { return a.number < b.number; });
}

std::string RandomStatistics::text() const {
  const auto count = [&](Ending ending) {
    const auto found = endings_.find(ending);
    return found == endings_.end() ? 0 : found->second;
  };
  std::string text = fmt::format(
      "{} programs, {} set points: {} followed to the end, {} stopped in a hold, {} refused, {} "
      "without end\n\n{:32} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
      programs_, set_points_, count(Ending::kWhole), count(Ending::kStopped),
      count(Ending::kRefused), count(Ending::kNone), "share of what is allowed", "programs",
      "median", "90 %", "99 %", "largest", "tolerated", "breaches");
  for (std::size_t i = 0; i < kMeasures; ++i) {
    std::vector<float> sorted = shares_[i];
    if (sorted.empty()) {
      continue;
    }
    std::sort(sorted.begin(), sorted.end());
    const auto measure = static_cast<Measure>(i);
    const auto broken = std::count_if(sorted.begin(), sorted.end(),
                                      [&](float share) { return share > tolerated(measure); });
    text +=
        fmt::format("{:32} {:8} {:9.4f} {:9.4f} {:9.4f} {:9.5g} {:9.4g} {:9}\n", name_of(measure),
                    sorted.size(), quantile(sorted, 0.5), quantile(sorted, 0.9),
                    quantile(sorted, 0.99), sorted.back(), tolerated(measure), broken);
  }
  text += fmt::format("\n{} programs break a promise, {} more by known defects\n", breaches_.size(),
                      known_);
  for (std::size_t i = 0; i < std::min(breaches_.size(), kShownBreaches); ++i) {
    text += fmt::format("program {}: {}\n", breaches_[i].number,
                        fmt::join(breaches_[i].findings, "; "));
  }
  return text;
}

std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(number),
                         static_cast<std::uint32_t>(number >> 32U)};
  std::mt19937 random(sequence);
  std::vector<std::uint8_t> bytes(60 + random() % 240);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random());
  }
  return bytes;
}

}  // namespace twin::fuzz
