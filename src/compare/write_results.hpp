#pragma once

#include "compare/comparison.hpp"
#include "core/error.hpp"
#include "report/workshop.hpp"

namespace twin::compare {

/// Writes compare.csv, fluctuation.csv, compare.json, compare.md and the pictures in the folder
/// figures; all of them or none.
///
/// @param draws  false leaves the pictures out
Expected<void> write_results(const Comparison& comparison, const report::Workshop& workshop,
                             bool draws);

}  // namespace twin::compare
