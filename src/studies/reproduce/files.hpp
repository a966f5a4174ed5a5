#pragma once

#include <string>
#include <vector>

#include "pictures/figure/album.hpp"
#include "studies/reproduce/reproduction.hpp"

/// Texts of the files that a reproduction leaves.
namespace twin::studies::reproduce {

/// tables.csv: one line a published figure and variant:
///   table,program,interpolator,feedrate_mm_per_min,variant,figure,unit,published,ours,ratio,mean,
///   sd,mean_ratio
/// The last three are empty where nothing was repeated.
std::string csv_text(const Reproduction& reproduction);

/// reproduce.json: source, machine, repeats, counts and the figures.
std::string json_text(const Reproduction& reproduction);

/// tables.md: the tables, the counts, what differs.
std::string markdown_text(const Reproduction& reproduction);

/// index.html: the same with the pictures.
std::string page_text(const Reproduction& reproduction,
                      const std::vector<pictures::Picture>& pictures);

/// The measured figures that are more than 30 % off as published, row by row; one sentence.
std::string unreached(const Reproduction& reproduction);

/// Why our figures differ from the published ones, one sentence or two each, with figures of these
/// runs.
std::vector<std::string> differences(const Reproduction& reproduction);

}  // namespace twin::studies::reproduce
