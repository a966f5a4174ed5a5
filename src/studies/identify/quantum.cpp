#include "studies/identify/quantum.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace twin::studies::identify {
namespace {

constexpr double kNoStep = 1e-10;        // rounding of a number in a file
constexpr double kWholeTolerance = 0.1;  // how far from whole a multiple may be
constexpr double kWholeShare = 0.98;     // of the steps that must be whole multiples
constexpr std::size_t kFewestSteps = 20;
constexpr double kMostMultiple = 50.0;  // larger steps say nothing of the quantum

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

}  // namespace

std::optional<double> quantum_of(std::span<const double> values) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step = std::abs(values[k] - values[k - 1]);
    if (step > kNoStep) {
      steps.push_back(step);
    }
  }
  if (steps.size() < kFewestSteps) {
    return std::nullopt;
  }
  std::ranges::sort(steps);
  // The very smallest may be a stray; a fast motion has few that are small.
  for (const std::size_t place : {std::size_t{0}, steps.size() / 1000, steps.size() / 200}) {
    if (const auto quantum = refined(steps, steps[place])) {
      return quantum;
    }
  }
  return std::nullopt;
}

}  // namespace twin::studies::identify
