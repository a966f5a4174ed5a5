#pragma once

#include <vector>

#include "identify/parameter.hpp"

namespace twin::reproduce {

/// What fit_tables() looks for, with the ranges it looks in.
std::vector<identify::Parameter> table_parameters();

}  // namespace twin::reproduce
