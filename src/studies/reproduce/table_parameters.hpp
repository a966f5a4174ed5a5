#pragma once

#include <vector>

#include "studies/identify/parameter.hpp"

namespace twin::studies::reproduce {

/// What fit_tables() looks for, with the ranges it looks in.
std::vector<studies::identify::Parameter> table_parameters();

}  // namespace twin::studies::reproduce
