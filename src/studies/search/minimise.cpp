#include "studies/search/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel_for.hpp"

namespace twin::studies::search {
namespace {

constexpr double kWorst = 1e300;  // cost of what has none
constexpr std::size_t kLeastPopulation = 5;

using Points = std::vector<std::vector<double>>;

bool is_asked_to_stop(const MinimiseOptions& options) {
  return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
}

/// The costs of points. After a stop the rest is not waited for, and what ended after it is worst.
std::vector<double> costs_of(const Points& points,
                             const std::function<double(std::span<const double>)>& objective,
                             const MinimiseOptions& options) {
  std::vector<double> costs(points.size(), kWorst);
  parallel_for(
      points.size(),
      [&](std::size_t k) {
        if (is_asked_to_stop(options)) {
          return;
        }
        const double cost = objective(points[k]);
        if (std::isfinite(cost) && !is_asked_to_stop(options)) {
          costs[k] = std::min(cost, kWorst);
        }
      },
      options.threads);
  return costs;
}

/// Keeps the best of a generation; the first of several that are as good.
void take_best(const Points& points, const std::vector<double>& costs, Minimum& best) {
  const auto least = std::ranges::min_element(costs);
  if (best.x.empty() || *least < best.cost) {
    best.x = points[static_cast<std::size_t>(least - costs.begin())];
    best.cost = *least;
  }
  best.evaluations += points.size();
}

/// The widest side of the box around a generation.
double extent(const Points& points) {
  double widest = 0.0;
  for (std::size_t i = 0; i < points.front().size(); ++i) {
    const auto [low, high] = std::ranges::minmax_element(
        points, [i](const auto& a, const auto& b) { return a[i] < b[i]; });
    widest = std::max(widest, (*high)[i] - (*low)[i]);
  }
  return widest;
}

std::size_t population_size(const MinimiseOptions& options) {
  const auto usual =
      4 + static_cast<std::size_t>(3.0 * std::log(static_cast<double>(options.start.size())));
  return std::max(options.population > 0 ? options.population : usual, kLeastPopulation);
}

void report(const Minimum& best, const MinimiseOptions& options) {
  if (options.progress) {
    const auto all = static_cast<double>(std::max<std::size_t>(options.evaluations, 1));
    options.progress(std::min(static_cast<double>(best.evaluations) / all, 1.0), best.cost);
  }
}

/// The state before the first generation, with the cost of the start.
SearchState begin(const std::function<double(std::span<const double>)>& objective,
                  const MinimiseOptions& options) {
  std::vector<double> start = options.start;
  std::ranges::for_each(start, [](double& x) { x = std::clamp(x, 0.0, 1.0); });
  SearchState state{CmaEs::start(start, options.spread), {}};
  const Points points{start};
  take_best(points, costs_of(points, objective, options), state.best);
  return state;
}

}  // namespace

Minimum minimise(const std::function<double(std::span<const double>)>& objective,
                 const MinimiseOptions& options) {
  if (options.start.empty()) {
    return {{}, objective({}), 0, false};
  }
  SearchState state = options.resumed ? *options.resumed : begin(objective, options);
  report(state.best, options);
  const std::size_t size = population_size(options);
  CmaEs search(state.cma, size, options.seed);
  while (!is_asked_to_stop(options) && state.best.evaluations + size <= options.evaluations + 1) {
    const Points points = search.ask();
    const std::vector<double> costs = costs_of(points, objective, options);
    take_best(points, costs, state.best);
    if (is_asked_to_stop(options)) {
      break;  // the generation is not whole: nothing is learnt from it
    }
    search.tell(costs);
    state.cma = search.state();
    report(state.best, options);
    if (options.save) {
      options.save(state);
    }
    if (extent(points) < options.precision) {
      break;
    }
  }
  state.best.was_stopped = is_asked_to_stop(options);
  return state.best;
}

}  // namespace twin::studies::search
