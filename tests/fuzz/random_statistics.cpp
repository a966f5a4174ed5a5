#include "tests/fuzz/random_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace twin::fuzz {
namespace {

constexpr std::array kSizes{1.02, 1.1, 1.5, 2.0};  // upper ends of the counts by size

double quantile(const std::vector<float>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// What a breach is counted as.
std::string kind_of(const Case& made, const Breach& breach) {
  const Limits& limits = made.machine.limits;
  const bool is_paper = made.machine.path.planner == Planner::kPaper;
  const bool has_axes =
      limits.axis_feedrate.any() || limits.axis_acceleration.any() || limits.axis_jerk.any();
  return fmt::format("{}{}{}: {}", is_paper ? "paper" : "certified",
                     has_axes && !is_paper ? ", axis limits" : "",
                     made.operations.empty() ? "" : ", override", breach.what);
}

void add_to(BreachKind& kind, const BreachKind& other) {
  const bool is_new = std::all_of(kind.counts.begin(), kind.counts.end(),
                                  [](std::uint64_t count) { return count == 0; });
  for (std::size_t i = 0; i < kind.counts.size(); ++i) {
    kind.counts[i] += other.counts[i];
  }
  if (is_new || other.largest > kind.largest) {
    kind.largest = other.largest;
    kind.worst = other.worst;
  }
  kind.first = is_new ? other.first : std::min(kind.first, other.first);
}

}  // namespace

void RandomStatistics::add(std::uint64_t number, const Case& made, const Outcome& outcome) {
  ++programs_;
  ++endings_[outcome.ending];
  set_points_ += outcome.set_points;
  for (std::size_t i = 0; i < kMeasures; ++i) {
    if (!std::isnan(outcome.shares[i])) {
      shares_[i].push_back(static_cast<float>(outcome.shares[i]));
    }
  }
  known_ += outcome.findings.empty() && !outcome.known.empty() ? 1 : 0;
  broken_ += outcome.findings.empty() ? 0 : 1;
  for (const Breach& breach : outcome.findings) {
    BreachKind one{.counts = {}, .largest = breach.share, .worst = number, .first = number};
    const auto size = std::lower_bound(kSizes.begin(), kSizes.end(), breach.share);
    one.counts[static_cast<std::size_t>(size - kSizes.begin())] = 1;
    add_to(kinds_[kind_of(made, breach)], one);
  }
}

void RandomStatistics::add(const RandomStatistics& other) {
  programs_ += other.programs_;
  set_points_ += other.set_points_;
  known_ += other.known_;
  broken_ += other.broken_;
  for (const auto& [ending, count] : other.endings_) {
    endings_[ending] += count;
  }
  for (std::size_t i = 0; i < kMeasures; ++i) {
    shares_[i].insert(shares_[i].end(), other.shares_[i].begin(), other.shares_[i].end());
  }
  for (const auto& [name, kind] : other.kinds_) {
    add_to(kinds_[name], kind);
  }
}

std::string RandomStatistics::text() const {
  const auto count = [&](Ending ending) {
    const auto found = endings_.find(ending);
    return found == endings_.end() ? 0 : found->second;
  };
  return fmt::format(
             "{} programs, {} set points: {} followed to the end, {} stopped in a hold, {} "
             "refused, "
             "{} without end\n\n",
             programs_, set_points_, count(Ending::kWhole), count(Ending::kStopped),
             count(Ending::kRefused), count(Ending::kNone)) +
         limits_text() +
         fmt::format("\n{} programs break a promise, {} more by known defects\n", broken_, known_) +
         kinds_text();
}

/// How near each limit comes.
std::string RandomStatistics::limits_text() const {
  std::string text =
      fmt::format("{:32} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "share of what is allowed",
                  "programs", "median", "90 %", "99 %", "largest", "tolerated", "breaches");
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
  return text;
}

/// What is broken, by kind and size.
std::string RandomStatistics::kinds_text() const {
  if (kinds_.empty()) {
    return "";
  }
  std::string text =
      fmt::format("\n{:64} {:>7} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9}\n", "broken promises",
                  "to 2 %", "10 %", "50 %", "100 %", "more", "largest", "program", "first");
  for (const auto& [name, kind] : kinds_) {
    const auto& n = kind.counts;
    text += fmt::format("{:64} {:7} {:7} {:7} {:7} {:7} {:9.5g} {:9} {:9}\n", name, n[0], n[1],
                        n[2], n[3], n[4], kind.largest, kind.worst, kind.first);
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
