#pragma once

#include "core/error.hpp"
#include "pictures/figure/workshop.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// Writes tables, page and pictures; the results' folder gets all of them or none.
///
/// @param draws  false leaves the pictures out
Expected<void> write_results(const Reproduction& reproduction, const pictures::Workshop& workshop,
                             bool draws);

}  // namespace twin::studies::reproduce
