#pragma once

#include <optional>
#include <span>

namespace twin::studies::identify {

/// Distance between the values that a rounded signal can have, as an encoder's counts are.
///
/// The smallest steps of the signal are taken for the quantum; it is accepted where nearly all
/// other steps are whole multiples of it, and then refined over all of them.
/// @param values  in the order of time
/// @returns the quantum in the values' unit, or nothing for a signal that is not rounded
std::optional<double> quantum_of(std::span<const double> values);

}  // namespace twin::studies::identify
