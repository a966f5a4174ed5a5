#pragma once

#include "core/text_table.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// The mark of ours / published.
Mark mark_of(double ours, double published);

/// A published table with ours below each row: as published and with the defaults, single run and
/// mean, and their ratios to the published numbers.
TextTable grid_of_table(const Reproduction& reproduction, int table);

/// How many of the numbers of Tables 4 and 5 lie within 10, 20 and 30 %.
TextTable grid_of_counts(const Reproduction& reproduction);

}  // namespace twin::studies::reproduce
