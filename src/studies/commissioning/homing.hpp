#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"

namespace twin::studies::commissioning {

/// What ends a move before its whole distance is covered.
enum class Until : std::uint8_t {
  kNothing,
  kLimitReached,  ///< the home switch opens
  kIndex,         ///< the encoder's index is met with the switch closed again
};

/// One move of homing.
struct HomingMove {
  hal::Axis axis = hal::kX;
  bool is_positive = false;  ///< the home switch is P-OT
  double distance = 0.0;     ///< signed; at most so far [mm]
  double feedrate = 0.0;     ///< [mm/s]
  Until until = Until::kNothing;
};

/// How a move ended. Positions are those of the encoder, from where the move began [mm].
struct HomingStop {
  double position = 0.0;         ///< at rest, at its end
  std::optional<double> met_at;  ///< where `until` came true; empty where it did not
};

/// Makes one move from rest to rest.
using MakeMove = std::function<Expected<HomingStop>(const HomingMove&)>;

/// Homes an axis by limit switch and index:
///
///   1. towards the switch until it opens,
///   2. slowly away from it to the first index behind where it closes,
///   3. to where the index was met, and from there by `zero`.
///
/// The axis then stands at its zero, to within a count and the distance of one period at
/// index_feedrate.
/// @param length  the axis' whole travel: the farthest way to the switch [mm]
/// @param lead    the farthest way from index to index [mm]
Expected<void> home_axis(hal::Axis axis, const config::HomeSettings& settings, double length,
                         double lead, const MakeMove& move);

}  // namespace twin::studies::commissioning
