#pragma once

#include <string>

#include "core/text_table.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Figures of the contestants, a column each, and the limits of the machine.
TextTable grid_of_interpolators(const Comparison& comparison);

/// Feedrate fluctuation, a column each parameter update; empty where no program has curves.
TextTable grid_of_fluctuations(const Comparison& comparison);

/// compare.csv: figure,unit,nurbs,bezier,linear,certified
std::string interpolators_csv(const Comparison& comparison);

/// fluctuation.csv: program,feedrate_rule,parameter_update,max_percent,rms_percent
std::string fluctuations_csv(const Comparison& comparison);

/// compare.json
std::string json_text(const Comparison& comparison);

/// compare.md
std::string markdown_text(const Comparison& comparison);

}  // namespace twin::studies::compare
