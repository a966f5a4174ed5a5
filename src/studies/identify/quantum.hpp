#pragma once

#include <optional>
#include <span>

namespace twin::studies::identify {

/// Distance between the values that a rounded signal can have, as an encoder's counts are.
///
/// The smallest steps of the signal are taken for the quantum; it is accepted where nearly all
/// other steps are whole multiples of it, and then refined over all of them. Where nearly all small
/// steps are multiples of a multiple of it, that is the quantum: rows that were interpolated over
/// late periods make steps that are parts of it.
/// @param values  in the order of time
/// @returns the quantum in the values' unit, or nothing for a signal that is not rounded
std::optional<double> quantum_of(std::span<const double> values);

/// The smallest change of a signal from row to row; nothing where it never changes.
std::optional<double> smallest_step(std::span<const double> values);

}  // namespace twin::studies::identify
