#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace twin::studies::batch {

/// Points of a Latin hypercube in the unit cube: in each dimension every one of `count` equal
/// intervals has one point, at a random place in it. The same seed gives the same points
/// everywhere.
///
/// Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239-245.
/// @returns (count x dimensions) numbers in [0, 1)
std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed);

/// Independent standard normal numbers, by the inverse of their distribution.
/// @returns (count x dimensions) numbers
std::vector<std::vector<double>> normal_samples(std::size_t count, std::size_t dimensions,
                                                std::uint64_t seed);

/// The number below which a standard normal number lies with probability p, 0 < p < 1.
double normal_quantile(double p);

}  // namespace twin::studies::batch
