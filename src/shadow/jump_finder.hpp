#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace twin::shadow {

/// Something that happens at one instant leaves a known shape in the whitened residual. Here are the
/// shapes that are looked for.
struct JumpShapes {
  double count = 0.0;        ///< step of the residual that one lost count makes; 0: not looked for
  std::vector<double> step;  ///< what a step of one leaves, period by period, until it is forgotten
  std::vector<double> force;  ///< the same of a constant force of 1 N on the slide; may be empty
};

/// The best of a stretch of time.
struct Jump {
  double gain = 0.0;  ///< of the likelihood, in variances of the noise, less the price of its time
  double size = 0.0;  ///< [counts] lost, or [N]
};

/// Looks for steps of whole counts against the motion, and for forces that begin.
///
/// With the first kMemory periods of a shape w and the whitened residual e of variance s^2, a jump of
/// size A at k gains
///   (2 A sum w_j e_(k+j) - A^2 S) / s^2,   S = sum w_j^2,
/// by the likelihood: for a force with its best A, for counts with the nearest whole number of them.
/// Nobody knows the time, so each jump pays 2 ln of the periods that a block has. Of jumps that are
/// nearer to each other than kMemory the best one counts; what it leaves is then taken off the
/// residual, so that it is not found again.
class JumpFinder {
 public:
  static constexpr std::size_t kMemory = 65;  ///< periods of a shape that are looked at

  /// @param shapes  of equal length  @param variance  s^2  @param block  its periods
  JumpFinder(JumpShapes shapes, double variance, std::size_t block);

  /// What was found in this period.
  struct Found {
    Jump counts;  ///< with a gain of 0 where there is none
    Jump force;
    double step = 0.0;  ///< of the residual, by the counts

    double gain() const noexcept { return std::max(counts.gain, force.gain); }
  };
  /// Takes a whitened residual of the motion. Real-time safe.
  /// @param direction  of the motion at the begin of the shapes; 0 where it was slow
  Found step(double residual, double direction) noexcept;
  /// The motion was interrupted.
  void reset() noexcept;

 private:
  double correlation(const std::vector<double>& shape) const noexcept;
  Found judge(double direction) const noexcept;
  void take_off(const Found& jump, std::size_t age) noexcept;

  JumpShapes shapes_;
  std::size_t memory_;
  double variance_;
  double price_;
  double step_square_ = 0.0;
  double force_square_ = 0.0;
  std::vector<double> residuals_;  // the last of them, a ring, each twice
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
  Found pending_;
  std::size_t age_ = 0;
  std::vector<double> to_come_;  // what found jumps will leave in coming residuals, a ring
  std::size_t coming_ = 0;
};

}  // namespace twin::shadow
