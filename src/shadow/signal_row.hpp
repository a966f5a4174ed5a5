#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "shadow/parameter.hpp"

namespace twin::shadow {

/// Residual of one period, and its signatures: what it changes by with each parameter, to first
/// order. A parameter that a channel does not show has a signature of 0.
struct SignalRow {
  double residual = 0.0;     ///< [um] or [N]
  PerParameter signature{};  ///< the same per unit of its cause
};

/// What a channel compares.
enum class ChannelKind {
  kPosition,  ///< position by the encoder with that of a model driven by the same volts [um]
  kCounts,    ///< the same, by the bounds that each count is [um]
  kScale,     ///< the same of the slide, by a scale of its own [um]
  kForce,     ///< force of the motor with what the motion needs [N]
};

/// "position", "counts", "scale" or "force".
std::string_view name_of(ChannelKind kind) noexcept;

/// Whether the level of a channel's residual says nothing, so that its increments are whitened.
constexpr bool is_differenced(ChannelKind kind) noexcept { return kind != ChannelKind::kForce; }

/// Whether a channel's level is followed by a CountFilter; else its residual is whitened.
constexpr bool is_followed(ChannelKind kind) noexcept { return kind == ChannelKind::kCounts; }

/// Coefficients of the filter that whitens a residual, at most: so many periods it looks back.
inline constexpr std::size_t kLongestFilter = 192;

inline constexpr std::size_t kChannels = 4;  ///< of an axis, at most

}  // namespace twin::shadow
