#pragma once

#include <string>

#include "studies/reproduce/table_fit.hpp"

namespace twin::studies::reproduce {

/// What a fit to the published tables found, as a table for the terminal.
std::string to_table(const TableFit& fit);

}  // namespace twin::studies::reproduce
