#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "studies/search/cma_es.hpp"

namespace twin::studies::search {

/// The best point that was found.
struct Minimum {
  std::vector<double> x;        ///< in the unit cube
  double cost = 0.0;            ///< there
  std::size_t evaluations = 0;  ///< that were made
  bool was_stopped = false;     ///< by the stop flag
};

/// A search between two generations.
struct SearchState {
  CmaState cma;
  Minimum best;  ///< so far
};

/// How to search.
struct MinimiseOptions {
  std::vector<double> start;       ///< where to begin, each in [0, 1]; its size is the dimension
  double spread = 0.2;             ///< first standard deviation of the search, of the unit cube
  std::size_t population = 0;      ///< points in a generation, at least 5; 0: 4 + 3 ln n
  std::size_t evaluations = 2000;  ///< at most so many, but the start and one generation at least
  std::uint32_t seed = 1;          ///< same seed, same result, on any number of cores
  double precision = 1e-6;         ///< ends when a generation spans less of the cube than this
  unsigned threads = 1;            ///< that evaluate a generation; 0: one for each core
  const std::atomic<bool>* stop = nullptr;  ///< set to end early with the best so far
  std::function<void(double, double)>
      progress;                        ///< gets the done share, 0 to 1, and the least cost
  std::optional<SearchState> resumed;  ///< goes on from here in place of the start
  std::function<void(const SearchState&)> save{};  ///< called after each generation
};

/// Finds a small value of a function on the unit cube [0, 1]^n by CMA-ES (CmaEs).
///
/// CMA-ES draws a generation from a normal distribution, moves its mean to the better half and adapts
/// covariance and step size; only the order of the costs matters, so scale, noise and steps of the
/// function do little harm. The result is the best point of all generations, never worse than the
/// start.
///
/// @param objective  cost of a point; not a number or infinite means worse than any other. With
///   more than one thread it is called from several at a time.
Minimum minimise(const std::function<double(std::span<const double>)>& objective,
                 const MinimiseOptions& options);

}  // namespace twin::studies::search
