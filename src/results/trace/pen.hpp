#pragma once

namespace twin::results {

/// Height of the pen above which it does not draw [mm]. A program that never comes below is drawn
/// all the same.
inline constexpr double kPenUp = 0.1;

}  // namespace twin::results
