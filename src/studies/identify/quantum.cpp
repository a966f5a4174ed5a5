#include "studies/identify/quantum.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace twin::studies::identify {
namespace {

constexpr double kNoStep = 1e-10;        // rounding of a number in a file
constexpr double kWholeTolerance = 0.1;  // how far from whole a multiple may be
constexpr double kWholeShare = 0.95;     // of the steps that must be whole multiples
constexpr std::size_t kFewestSteps = 20;
constexpr double kMostMultiple = 50.0;  // larger steps say nothing of the quantum
constexpr int kMostParts = 12;          // that interpolation makes of a quantum
constexpr double kPartShare = 0.8;      // of the small steps, that must be whole quanta
constexpr double kSmallMultiple = 5.5;

/// Refines a guess over all steps that are small multiples of it; nothing if few steps are.
std::optional<double> refined(const std::vector<double>& sorted_steps, double guess) {
  double quantum = guess;
  std::size_t whole = 0;
  std::size_t tried = 0;
  for (const double step : sorted_steps) {
    // The more steps agree, the larger multiples can be told from their neighbours.
    const double multiple = step / quantum;
    if (multiple > kMostMultiple) {
      break;
    }
    ++tried;
    const double nearest = std::round(multiple);
    if (nearest >= 1.0 && std::abs(multiple - nearest) < kWholeTolerance) {
      ++whole;
      quantum += (step / nearest - quantum) / static_cast<double>(whole);
    }
  }
  const bool is_whole = static_cast<double>(whole) >= kWholeShare * static_cast<double>(tried);
  return tried >= kFewestSteps && is_whole ? std::optional(quantum) : std::nullopt;
}

/// The quantum of which a guess is a part: rows interpolated over n periods make steps of 1 / n, but
/// nearly all small steps are whole quanta.
double whole_of_parts(const std::vector<double>& sorted_steps, double guess) {
  for (int parts = kMostParts; parts > 1; --parts) {
    const double whole = parts * guess;
    std::size_t tried = 0;
    std::size_t agree = 0;
    for (const double step : sorted_steps) {
      const double multiple = step / whole;
      if (multiple > kSmallMultiple) {
        break;
      }
      ++tried;
      const double nearest = std::round(multiple);
      agree += nearest >= 1.0 && std::abs(multiple - nearest) < kWholeTolerance ? 1 : 0;
    }
    if (tried >= kFewestSteps &&
        static_cast<double>(agree) >= kPartShare * static_cast<double>(tried)) {
      return refined(sorted_steps, whole).value_or(whole);
    }
  }
  return guess;
}

std::vector<double> steps_of(std::span<const double> values) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step = std::abs(values[k] - values[k - 1]);
    if (step > kNoStep) {
      steps.push_back(step);
    }
  }
  std::ranges::sort(steps);
  return steps;
}

}  // namespace

std::optional<double> quantum_of(std::span<const double> values) {
  const std::vector<double> steps = steps_of(values);
  if (steps.size() < kFewestSteps) {
    return std::nullopt;
  }
  // The very smallest may be a stray; a fast motion has few that are small.
  for (const std::size_t share : {0, 1, 5, 10, 20, 50, 100}) {
    if (const auto quantum = refined(steps, steps[steps.size() * share / 1000])) {
      return whole_of_parts(steps, *quantum);
    }
  }
  return std::nullopt;
}

std::optional<double> smallest_step(std::span<const double> values) {
  const std::vector<double> steps = steps_of(values);
  return steps.empty() ? std::nullopt : std::optional(steps.front());
}

}  // namespace twin::studies::identify
