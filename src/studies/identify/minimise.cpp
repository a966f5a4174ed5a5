#include "studies/identify/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

// The only file that knows pagmo, whose headers are slow to compile.
namespace twin::studies::identify {
namespace {

constexpr double kWorst = 1e300;             // cost of what has none
constexpr std::size_t kLeastPopulation = 5;  // pagmo's

/// The best point so far and what ends the search; pagmo copies problems, so they share one.
struct Search {
  const std::function<double(std::span<const double>)>& objective;
  const MinimiseOptions& options;
  Minimum best;

  bool is_stopped() const {
    return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
  }

  double evaluate(const std::vector<double>& x) {
    if (is_stopped()) {
      best.was_stopped = true;
      return kWorst;  // the rest of the generation is not waited for
    }
    ++best.evaluations;
    const double cost = objective(x);
    if (is_stopped()) {  // perhaps in the middle of it
      best.was_stopped = true;
      return kWorst;
    }
    const double known = std::isfinite(cost) ? std::min(cost, kWorst) : kWorst;
    if (best.x.empty() || known < best.cost) {
      best.x = x;
      best.cost = known;
    }
    return known;
  }

  void report() const {
    if (options.progress) {
      options.progress(
          std::min(static_cast<double>(best.evaluations) /
                       static_cast<double>(std::max<std::size_t>(options.evaluations, 1)),
                   1.0),
          best.cost);
    }
  }
};

/// The unit cube as pagmo sees it.
struct Cube {
  Search* search = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {search->evaluate(x)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const std::size_t n = search != nullptr ? search->options.start.size() : 1;
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
};

/// The widest side of the box around a generation.
double extent(const pagmo::population& population) {
  double widest = 0.0;
  const auto points = population.get_x();
  for (std::size_t i = 0; i < points.front().size(); ++i) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [i](const auto& a, const auto& b) { return a[i] < b[i]; });
    widest = std::max(widest, (*high)[i] - (*low)[i]);
  }
  return widest;
}

std::size_t population_size(const MinimiseOptions& options) {
  const auto usual =
      4 + static_cast<std::size_t>(3.0 * std::log(static_cast<double>(options.start.size())));
  return std::max(options.population > 0 ? options.population : usual, kLeastPopulation);
}

}  // namespace

Minimum minimise(const std::function<double(std::span<const double>)>& objective,
                 const MinimiseOptions& options) {
  Search search{objective, options, {}};
  if (options.start.empty()) {
    search.best.cost = objective({});
    return search.best;
  }
  std::vector<double> start = options.start;
  std::ranges::for_each(start, [](double& x) { x = std::clamp(x, 0.0, 1.0); });
  const double first = search.evaluate(start);
  if (search.best.x.empty()) {  // stopped before anything began
    search.best.x = start;
    search.best.cost = kWorst;
    return search.best;
  }
  search.report();

  pagmo::population population(pagmo::problem(Cube{&search}), 0, options.seed);
  const std::size_t size = population_size(options);
  for (std::size_t i = 0; i < size; ++i) {
    population.push_back(start, {first});  // the search begins at the best of these
  }
  // One generation a call; no tolerances of its own, within the cube.
  const pagmo::algorithm one_generation(
      pagmo::cmaes(1, -1, -1, -1, -1, options.spread, 0.0, 0.0, true, true, options.seed));
  while (!search.best.was_stopped && search.best.evaluations + size <= options.evaluations + 1) {
    population = one_generation.evolve(population);
    search.report();
    if (extent(population) < options.precision) {
      break;
    }
  }
  return search.best;
}

}  // namespace twin::studies::identify
