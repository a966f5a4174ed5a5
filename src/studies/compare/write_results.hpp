#pragma once

#include "core/error.hpp"
#include "pictures/figure/workshop.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Writes compare.csv, fluctuation.csv, compare.json, compare.md and the pictures in the folder
/// figures; all of them or none.
///
/// @param draws  false leaves the pictures out
Expected<void> write_results(const Comparison& comparison, const pictures::Workshop& workshop,
                             bool draws);

}  // namespace twin::studies::compare
