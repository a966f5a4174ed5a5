#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text_table.hpp"
#include "pictures/figure/album.hpp"
#include "pictures/figure/workshop.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// The mark of ours / published.
Mark mark_of(double ours, double published);

/// A published table with ours below each row: as published and with the defaults, single run and
/// mean, and their ratios to the published numbers.
TextTable grid_of_table(const Reproduction& reproduction, int table);

/// How many of the numbers of Tables 4 and 5 lie within 10, 20 and 30 %.
TextTable grid_of_counts(const Reproduction& reproduction);

/// tables.csv: one line for each published number and variant:
///   table,program,interpolator,feedrate_mm_per_min,variant,figure,unit,published,ours,ratio,mean,
///   sd,mean_ratio
/// The last three are empty where nothing was repeated.
std::string csv_text(const Reproduction& reproduction);

/// reproduce.json: source, machine, repeats, counts and the numbers.
std::string json_text(const Reproduction& reproduction);

/// tables.md: the tables, the counts, what differs.
std::string markdown_text(const Reproduction& reproduction);

/// index.html: the same with the pictures.
std::string page_text(const Reproduction& reproduction,
                      const std::vector<pictures::Picture>& pictures);

/// One sentence that names, row by row, the measured numbers that are more than 30 % off as
/// published.
std::string unreached(const Reproduction& reproduction);

/// Why our numbers differ from the published ones: a few sentences for each reason, with numbers of
/// these runs.
std::vector<std::string> differences(const Reproduction& reproduction);

/// Writes tables, page and pictures; the results' folder gets all of them or none.
Expected<void> write_results(const Reproduction& reproduction, const pictures::Workshop& workshop,
                             pictures::Drawing drawing);

}  // namespace twin::studies::reproduce
