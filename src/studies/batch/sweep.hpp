#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "studies/batch/job.hpp"

namespace twin::studies::batch {

/// A setting of a sweep with the values that it takes. The key "program" or "feedrate_mm_per_min"
/// stands for what is no setting of the machine.
struct ListedKey {
  std::string key;
  std::vector<std::string> values;  ///< as --set takes them
};

/// A setting whose value is drawn: anywhere in a range, or by a normal distribution.
struct DrawnKey {
  std::string key;
  double from = 0.0;  ///< lower end; or the mean
  double to = 0.0;    ///< upper end; or the standard deviation
};

/// A sweep: jobs that differ in some keys.
///
///   grid             every combination of the listed values
///   latin_hypercube  count points that fill the ranges evenly
///   monte_carlo      count points of independent normal distributions
///
/// What is there is combined: every point of one with every point of the others.
struct Sweep {
  Job base;  ///< what all jobs share
  std::vector<ListedKey> grid;
  std::vector<DrawnKey> hypercube;
  std::size_t hypercube_count = 0;
  std::uint64_t hypercube_seed = 1;
  std::vector<DrawnKey> normal;
  std::size_t normal_count = 0;
  std::uint64_t normal_seed = 1;
};

/// One job of a sweep with the values of its keys, in the order of keys_of().
struct SweepPoint {
  Job job;
  std::vector<std::string> values;
};

/// The keys of a sweep: of the grid, of the hypercube, of the normal distributions.
std::vector<std::string> keys_of(const Sweep& sweep);

/// The jobs of a sweep; the key listed last changes first.
/// @returns an error for more than kMostJobs
Expected<std::vector<SweepPoint>> points_of(const Sweep& sweep);

}  // namespace twin::studies::batch
