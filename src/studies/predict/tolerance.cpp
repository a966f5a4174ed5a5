#include "studies/predict/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>

#include "core/parallel_for.hpp"
#include "core/units.hpp"
#include "studies/compensate/model_run.hpp"

namespace twin::studies::predict {
namespace {

constexpr double kTwoSided = 1.959963984540054;  // deviations of 95 %

/// The largest error of feed motion, and those of stretches.
double note_errors(const compensate::ContourPath& path, const std::vector<Vec2>& errors,
                   std::span<const std::size_t> stretches, std::vector<double>& on_stretch) {
  double largest = 0.0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!path.is_feed(k)) {
      continue;
    }
    const double size = errors[k].norm();
    largest = std::max(largest, size);
    if (!stretches.empty()) {
      double& of_stretch = on_stretch[stretches[k]];
      of_stretch = std::max(of_stretch, size);
    }
  }
  return largest;
}

}  // namespace

std::size_t Question::may_fail(std::size_t machines) const {
  const auto keep =
      static_cast<std::size_t>(std::ceil(share_ * static_cast<double>(machines) - 1e-9));
  return machines - std::clamp<std::size_t>(keep, 1, std::max<std::size_t>(machines, 1));
}

std::vector<std::size_t> Question::order(std::size_t machines) const {
  std::vector<std::size_t> order(machines);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (badness_.size() == machines) {
    std::ranges::stable_sort(order, std::greater<>(),
                             [this](std::size_t i) { return badness_[i]; });
  }
  return order;
}

void Question::learn(std::span<const double> largest) {
  badness_.resize(largest.size(), 0.0);
  for (std::size_t i = 0; i < largest.size(); ++i) {
    badness_[i] = std::isfinite(largest[i]) ? largest[i] : badness_[i];
  }
}

Expected<PossibleErrors> possible_errors(const compensate::ContourPath& path,
                                         const Uncertainty& uncertainty,
                                         std::span<const Vec2> offsets,
                                         std::span<const std::size_t> stretches,
                                         const ToleranceOptions& options) {
  PossibleErrors errors;
  errors.largest.assign(options.machines, 0.0);
  std::size_t count = 0;
  for (const std::size_t stretch : stretches) {
    count = std::max(count, stretch + 1);
  }
  errors.on_stretch.assign(options.machines, std::vector<double>(count, 0.0));
  std::mutex mutex;  // of progress
  std::size_t done = 0;
  const auto is_stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  Question* const question = options.question;
  const std::vector<std::size_t> order =
      question != nullptr ? question->order(options.machines) : std::vector<std::size_t>();
  std::atomic<std::size_t> failed{0};
  parallel_for(options.machines, [&](std::size_t at) {
    const std::size_t i = order.empty() ? at : order[at];
    if (is_stopped()) {
      return;
    }
    if (question != nullptr && failed.load() > question->may_fail(options.machines)) {
      errors.largest[i] = std::numeric_limits<double>::infinity();
      return;
    }
    const PossibleMachine possible = uncertainty.draw(options.seed, i);
    const compensate::ModelRun run =
        compensate::run_model(possible.machine, path.points(), offsets, possible.phases);
    if (run.has_failed) {
      errors.largest[i] = std::numeric_limits<double>::infinity();
      std::ranges::fill(errors.on_stretch[i], errors.largest[i]);
    } else {
      errors.largest[i] =
          note_errors(path, path.errors(run.table), stretches, errors.on_stretch[i]);
    }
    if (question != nullptr && errors.largest[i] > question->tolerance()) {
      ++failed;
    }
    if (options.progress) {
      const std::lock_guard lock(mutex);
      options.progress(static_cast<double>(++done) / static_cast<double>(options.machines));
    }
  });
  if (is_stopped()) {
    return fail(ErrorCode::kInterrupted, "interrupted");
  }
  if (question != nullptr) {
    question->learn(errors.largest);
  }
  return errors;
}

double quantile(std::span<const double> errors, double share) {
  if (errors.empty()) {
    return 0.0;
  }
  std::vector<double> sorted(errors.begin(), errors.end());
  std::ranges::sort(sorted);
  const auto rank =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size()) - 1e-9));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

TolerancePrediction predict(std::span<const double> largest, double tolerance) {
  TolerancePrediction prediction;
  prediction.tolerance = tolerance;
  prediction.machines = largest.size();
  prediction.within = static_cast<std::size_t>(
      std::ranges::count_if(largest, [tolerance](double error) { return error <= tolerance; }));
  const auto n = static_cast<double>(std::max<std::size_t>(largest.size(), 1));
  const double p = static_cast<double>(prediction.within) / n;
  const double z2 = kTwoSided * kTwoSided;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kTwoSided * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  prediction.low = std::max(middle - half, 0.0);
  prediction.high = std::min(middle + half, 1.0);
  prediction.median = quantile(largest, 0.5);
  prediction.p95 = quantile(largest, 0.95);
  return prediction;
}

std::string TolerancePrediction::text() const {
  return fmt::format(
      "contour error of the table within {:g} um with probability {:.3f} ({:.3f} to {:.3f}, 95 % "
      "sure); {} possible machines: median {:.2f} um, 95 % within {:.2f} um",
      units::um_from_mm(tolerance), probability(), low, high, machines, units::um_from_mm(median),
      units::um_from_mm(p95));
}

}  // namespace twin::studies::predict
