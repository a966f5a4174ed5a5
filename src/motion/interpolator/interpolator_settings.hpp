#pragma once

#include <cstdint>

namespace twin::motion {

/// How the parameter of a curve goes on from one period to the next.
enum class ParameterUpdate : std::uint8_t {
  kTaylor1,      ///< first-order Taylor step
  kTaylor2,      ///< second-order Taylor step, as printed [WY09, Eq. 23]
  kRungeKutta4,  ///< classical Runge-Kutta step of du/dt = V(t) / |C'(u)|
  kCorrected,    ///< the Taylor step predicts, the arc length corrects: exact
};

/// What happens in the period in which a curve ends.
enum class CurveEnd : std::uint8_t {
  kCarry,  ///< the remainder of the period is travelled on the next segment
  kLand,   ///< the set point lands on the curve's end, and the remainder is lost, as steps 1 to 4
           ///< of [WY09, Section 3.3] have it
};

/// Variants of the interpolator.
struct InterpolatorSettings {
  ParameterUpdate update = ParameterUpdate::kCorrected;
  CurveEnd curve_end = CurveEnd::kCarry;
};

}  // namespace twin::motion
