#pragma once

#include <string>

#include "core/error.hpp"
#include "core/text_table.hpp"
#include "pictures/figure/workshop.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Quantities of the contestants, a column each, and the limits of the machine.
TextTable grid_of_interpolators(const Comparison& comparison);

/// Feedrate fluctuation, a column each parameter update; empty where no program has curves.
TextTable grid_of_fluctuations(const Comparison& comparison);

/// compare.csv: a line each quantity, with the header figure,unit,nurbs,bezier,linear,certified.
/// A field is empty where a contestant has no such quantity.
std::string interpolators_csv(const Comparison& comparison);

/// fluctuation.csv: program,feedrate_rule,parameter_update,max_percent,rms_percent
std::string fluctuations_csv(const Comparison& comparison);

/// compare.json
std::string json_text(const Comparison& comparison);

/// compare.md
std::string markdown_text(const Comparison& comparison);

/// Writes compare.csv, fluctuation.csv, compare.json, compare.md and the pictures in the folder
/// figures; all of them or none.
Expected<void> write_results(const Comparison& comparison, const pictures::Workshop& workshop,
                             pictures::Drawing drawing);

}  // namespace twin::studies::compare
