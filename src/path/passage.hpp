#pragma once

namespace twin::path {

/// How a corner that is rounded by a bump is passed where the jerk of axes bounds the feedrate in it:
/// half of the passage, from the corner on.
///
///   v  |            .---- F          h  half width of the bump [mm]
///      |          /                  V  feedrate that the bump allows [mm/s]
///    V |_       /'                   r  share of V at the corner itself
///      | '-.__/'
///  r V |___'|_________________ s
///           h
///
/// The feedrate rises from r V with a constant jerk over the bump, which takes
///   T = 3 h / (V (1 + 2 r)),   with the acceleration a = 2 V (1 - r) / T at its end,
/// and from there with the jerk J until a = 0 at F. Where that takes more jerk than the bend leaves,
/// the feedrate rises with what is left, to less than V. A lower r costs time in the bump and saves
/// time after it.
struct Bump {
  double half_width;  ///< h > 0 [mm]
  double feedrate;    ///< V > 0 [mm/s]
  double jerk;        ///< left to the motion along the path in the bend, > 0 [mm/s^3]
};

struct Passage {
  double dip = 1.0;   ///< r of the least loss [-]
  double loss = 0.0;  ///< time beside that of running at F [s]
};

/// The passage of the least loss.
/// @param feedrate  F > 0 [mm/s]
/// @param jerk      J > 0 [mm/s^3]
Passage best_passage(const Bump& bump, double feedrate, double jerk) noexcept;

/// Time that is lost with a stop at the corner itself, on one side of it [s].
double stop_loss(double feedrate, double jerk) noexcept;

/// Feedrate that a rise from rest with the jerk J reaches within a distance, at most F [mm/s].
double feedrate_within(double distance, double feedrate, double jerk) noexcept;

}  // namespace twin::path
