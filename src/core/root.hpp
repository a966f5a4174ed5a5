#pragma once

#include <cmath>

/// Roots of an increasing function f of one variable inside a bracket, low < root < high.
///
/// Both searches stay inside the bracket: each evaluation of f moves one end of the bracket to the
/// argument that was evaluated, the high end where f > 0 and the low end elsewhere. They allocate
/// nothing. They evaluate f no more often than their tolerance allows, so they end even for a
/// function that is not increasing or not finite.
namespace twin {

/// f and df/dx at one argument.
struct ValueAndSlope {
  double value;
  double slope;
};

/// When a search by Newton's method ends. A field that is left alone ends nothing.
struct NewtonTolerance {
  double value = -1.0;          ///< at an x with |f(x)| of at most this
  double newton_step = 0.0;     ///< after a Newton step shorter than this
  double bisection_step = 0.0;  ///< after a bisection shorter than this
  int iterations = 60;          ///< after so many evaluations; bisection alone needs about 53
};

/// What a search by Newton's method found.
struct NewtonRoot {
  double x;     ///< the root, as well as it is known
  double low;   ///< the bracket that is left
  double high;  ///< of the same unit as x
  bool is_met;  ///< whether |f(x)| is within the tolerance of the value
};

/// Root of an increasing function by Newton's method inside a bracket.
///
/// The next argument is
///   x - f(x) / f'(x)   where that lies strictly inside the bracket,
///   (low + high) / 2   elsewhere.
/// Near a simple root each step squares the error. A slope that is zero, not finite or of the wrong
/// sign points out of the bracket, because x itself has just become its end; the step is then a
/// bisection.
///
/// @param f          callable as f(x) -> ValueAndSlope
/// @param low, high  the bracket; f is not evaluated at its ends unless x is one of them
/// @param x          first argument, within the bracket
/// @param tolerance  when the search ends
/// @note Real-time safe if f is.
template <class Function>
NewtonRoot bracketed_newton(const Function& f, double low, double high, double x,
                            const NewtonTolerance& tolerance) noexcept {
  for (int i = 0; i < tolerance.iterations; ++i) {
    const ValueAndSlope at = f(x);
    if (std::abs(at.value) <= tolerance.value) {
      return {x, low, high, true};
    }
    (at.value > 0.0 ? high : low) = x;
    const double newton = x - at.value / at.slope;
    const bool is_inside = newton > low && newton < high;  // false for NaN
    const double next = is_inside ? newton : 0.5 * (low + high);
    const double step = std::abs(next - x);
    x = next;
    if (step < (is_inside ? tolerance.newton_step : tolerance.bisection_step)) {
      break;
    }
  }
  return {x, low, high, false};
}

/// When a search by regula falsi ends, and how often it bisects.
struct FalsiTolerance {
  double value = 0.0;    ///< at a low end with -value < f <= 0
  double width = 1e-14;  ///< when the bracket is no wider than this share of its high end [-]
  int iterations = 100;  ///< after so many evaluations
  int bisect_every = 3;  ///< one of so many evaluations is a bisection, whatever the function
};

/// Argument of an increasing function just below its root, by regula falsi with the Illinois rule.
///
/// The next argument is the zero of the straight line through both ends of the bracket,
///   (low f_high - high f_low) / (f_high - f_low).
/// It is the middle of the bracket instead where rounding puts that zero outside, and every few
/// steps, so that the bracket shrinks for certain. Plain regula falsi keeps one end of the bracket
/// for ever where the function is curved. The Illinois rule therefore halves the value of the end
/// that stays, which moves the next argument across the root. No slope is needed.
///
/// @param f              callable as f(x) -> double
/// @param low, high      the bracket
/// @param f_low, f_high  values of f there, f_low < 0 < f_high
/// @param tolerance      when the search ends
/// @returns the low end of the bracket that is left, where f <= 0
/// @note Real-time safe if f is.
template <class Function>
double root_from_below(const Function& f, double low, double f_low, double high, double f_high,
                       const FalsiTolerance& tolerance) noexcept {
  for (int i = 0; i < tolerance.iterations && high - low > tolerance.width * high; ++i) {
    const bool is_bisection = i % tolerance.bisect_every == tolerance.bisect_every - 1;
    double x = (low * f_high - high * f_low) / (f_high - f_low);
    if (is_bisection || !(x > low && x < high)) {
      x = 0.5 * (low + high);
    }
    const double value = f(x);
    const double kept = is_bisection ? 1.0 : 0.5;
    if (value > 0.0) {
      high = x;
      f_high = value;
      f_low *= kept;
    } else {
      low = x;
      f_low = value;
      f_high *= kept;
      if (value > -tolerance.value) {
        break;
      }
    }
  }
  return low;
}

}  // namespace twin
