#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/vec.hpp"

namespace twin::gcode {

/// The numbers of one line with G76. What is not in mm is in the units of the program, in which the
/// control counts the passes.
struct ThreadLine {
  Vec3 start = Vec3::Zero();     ///< where the tool is: the drive line [mm]
  Vec3 end = Vec3::Zero();       ///< where the line leads; its Z is the end of the thread [mm]
  double crest = 0.0;            ///< I, from the drive line to the crest; above zero: inside a bore
  double first_cut = 0.0;        ///< J, depth of the first pass, above zero
  double height = 0.0;           ///< K, depth of the thread, above J
  double degression = 1.0;       ///< R, 1 or more: passes get the thinner, the larger it is
  double angle = 0.0;            ///< Q, of the compound slide [rad]
  double taper = 0.0;            ///< E, length of a taper; 0: none
  bool has_entry = false;        ///< a taper where the thread begins
  bool has_exit = false;         ///< a taper where it ends
  std::int64_t spring_cuts = 0;  ///< H, further passes at the full depth
  double unit = 1.0;             ///< length of the program's unit [mm]
  double feedrate = 0.0;         ///< P times the speed of the spindle [mm/s]
};

/// One move of a thread.
struct ThreadMove {
  Vec3 place = Vec3::Zero();  ///< where it leads, in the coordinates of the program [mm]
  double feedrate = 0.0;      ///< [mm/s]; 0: a rapid
};

/// The moves of LinuxCNC's threading cycle G76, one at a time.
///
/// With the drive line at X = x, s = 1 inside a bore and -1 outside, a pass of depth d from the
/// drive line, taken along Z from z - c to t - c, has the moves
///   rapid to X = x + s (d - I - K), the clearance   rapid in to x + s d
///   feed to the end of the thread at x + s d        rapid out to the clearance
/// where I and K are without sign, c = (d - I) tan Q is the shift by the compound slide and
/// t = end + K tan Q. A taper of length E begins or ends at x + s (d - K) instead, and is followed
/// with the same rate along Z. The depths are d_n = I + J n^(1/R), n = 1, 2, ..., while they are
/// less than I + K, and then I + K, as often as there are spring cuts and once more. Source:
/// LinuxCNC, G-Code manual, "G76 Threading Cycle"; the clearance and the tapers from the moves that
/// its interpreter (`rs274` 2.9) makes.
class ThreadingCycle {
 public:
  static constexpr double kMostPasses = 10000.0;

  /// Nothing to do.
  ThreadingCycle() = default;
  explicit ThreadingCycle(const ThreadLine& line);

  /// The next move, which may have no length; nullopt at the end.
  std::optional<ThreadMove> next();
  bool is_done() const noexcept { return is_done_; }

 private:
  void begin_pass();
  void add(double across, double along, double feedrate);

  ThreadLine line_;
  std::array<ThreadMove, 6> moves_{};  // of the pass
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::int64_t pass_ = 0;   // of those that get deeper
  std::int64_t final_ = 0;  // passes at the full depth
  bool is_done_ = true;
};

}  // namespace twin::gcode
