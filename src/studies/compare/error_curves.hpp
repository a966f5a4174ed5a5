#pragma once

#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "results/trace/decimator.hpp"

namespace twin::studies::compare {

/// Largest value in each of a number of equal stretches of time. It is drawn in place of a noisy
/// curve, so that several of them can be laid over each other.
///
/// @param pieces  stretches, at least 1
/// @param table   columns t [s] and value; t ascends
/// @returns columns t, the middle of the stretch, and value; stretches without rows are left out
results::Table running_maximum(const results::Table& table, std::size_t pieces);

/// Contour error of a trace over time.
/// @returns columns t_s, contour_error_um
Expected<results::Table> read_contour_error(const std::filesystem::path& trace);

/// Feedrate fluctuation of each period of a trace, see results::FeedrateFluctuation; periods that
/// are not counted there are left out.
///
/// @param period  [s]
/// @returns columns t [s], share [%]
Expected<results::Table> read_fluctuation(const std::filesystem::path& trace, double period);

}  // namespace twin::studies::compare
