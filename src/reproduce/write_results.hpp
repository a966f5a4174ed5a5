#pragma once

#include "core/error.hpp"
#include "report/workshop.hpp"
#include "reproduce/reproduction.hpp"

namespace twin::reproduce {

/// Writes tables, page and pictures; the results' folder gets all of them or none.
///
/// @param draws  false leaves the pictures out
Expected<void> write_results(const Reproduction& reproduction, const report::Workshop& workshop,
                             bool draws);

}  // namespace twin::reproduce
