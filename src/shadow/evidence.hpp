#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shadow/baseline.hpp"
#include "shadow/channel_filter.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// When and where something was.
struct Moment {
  double time = 0.0;      ///< since the first set point [s]
  std::int64_t line = 0;  ///< of the NC program; 0: unknown
  double moving = 0.0;    ///< time for which the axis has moved until then [s]
};

/// What speaks for one cause.
struct Hypothesis {
  Cause cause = Cause::kFriction;
  double statistic = 0.0;  ///< T, to be held against a threshold
  double evidence = 0.0;   ///< what it explains of the residual, in variances of the noise
  double change = 0.0;     ///< of the parameter against the healthy machine
  double deviation = 0.0;  ///< standard deviation of it
  Moment since;
};

/// The most likely change of one parameter and what it explains.
struct Fitted {
  double change = 0.0;     ///< theta, within its limit
  double explained = 0.0;  ///< 2 theta h - theta^2 G
};
inline Fitted fitted(double score, double information, double limit) noexcept {
  const double change = std::clamp(score / information, -limit, limit);
  return {change, change * (2.0 * score - change * information)};
}

/// Sums of slopes and curvatures of one channel's likelihood over the motion, and the tests on them.
///
/// Sums are kept in blocks of 50 periods of motion. For a change of parameter i at the begin of a
/// block, with h = sum z_i g and G = sum w z_i^2 from there on, the likelihood is largest for
///   theta = h / G,   and twice its logarithm gains   h^2 / G                  [Willsky, Jones 1976],
/// where a whitened residual e of variance s^2 has slope g = e / s^2 and curvature w = 1 / s^2. The
/// healthy machine makes scores h of variance
///   q G + t^2 G^2,
/// q from what is not white, t from what the model does not have, so that
///   T = h^2 / (q G + t^2 G^2)
/// is to be compared with a threshold. The begin is the block for which T is largest: a change at
/// once, a change before the run and a slow one are found alike.
///
/// theta is kept within what is plausible, and the likelihood is that of the bounded value.
///
/// Lost counts are told by the channel's filter, and their gains add up. A parameter that changes at
/// once is a force that begins, too: the force has sums h_o, G_oo and G_oi with the parameter's
/// signature over its own time, and is taken off the parameter by
///   h = h_i - h_o G_oi / G_oo,   G = G_ii - G_oi^2 / G_oo,
/// what it explains by itself being added. Where only the residual's shape after a force is known,
/// and no G_oi, the parameter begins when the whitener has forgotten the force.
class Evidence {
 public:
  static constexpr std::size_t kBlock = 50;  ///< periods of motion

  /// @param most_blocks  that are kept; where there are more, old ones are put together. Allocates.
  explicit Evidence(const ChannelBaseline& baseline, std::size_t most_blocks = 256);

  /// Takes what a channel's filter has made of a period of motion. Real-time safe.
  /// @param filter  it, for forces that began  @param counts  that passed by in this period
  /// @returns whether a block is complete, so that the tests have something new
  bool add(const ChannelFilter::Output& output, const ChannelFilter& filter, double counts,
           const Moment& now) noexcept;

  /// The best begin for each cause that has any evidence. Real-time safe.
  std::array<Hypothesis, kCauses> hypotheses() const noexcept;

  /// Sums over blocks, for whoever learns.
  struct Block {
    Moment begin;
    PerParameter score{};        // h
    PerParameter information{};  // G
    double steps = 0.0;          // gain by lost counts
    double lost = 0.0;           // counts lost
    double events = 0.0;         // at which they were lost
    double passed = 0.0;         // counts that went by
    Jump force;                  // the best one
    Onset onset;                 // its sums, where they are known
  };
  const std::vector<Block>& blocks() const noexcept { return blocks_; }

 private:
  void close(const OnsetBank* onsets) noexcept;
  void merge() noexcept;
  /// @param gain  what a force that began explains besides
  void judge_parameters(const Block& sum, const Block& begin, double gain,
                        std::array<Hypothesis, kCauses>& best) const noexcept;
  static Block without_onset(Block sum, const Onset& onset) noexcept;
  void judge_jumps(const Block& sum, const Block& begin,
                   std::array<Hypothesis, kCauses>& best) const noexcept;

  ChannelBaseline baseline_;
  std::size_t most_blocks_;
  std::vector<Block> blocks_;
  Block open_;
  std::size_t in_block_ = 0;
};

/// Threshold of T for a rate of false alarms.
///
/// Scores are normal sums, so T of one test is chi-squared; a mean time between false alarms H, over
/// all tests of a period, is kept by h with P(chi^2 > h) = p / (tests in H). What the variances were
/// learnt from few windows n makes the tail that of Student's t^2 with n degrees of freedom,
///   h_n = n (exp(h / (n + 1)) - 1).
/// @param hours    mean time between false alarms [h]
/// @param block    time of a block [s]
/// @param windows  n; 0: the variances are known
double threshold_of(double hours, double block, std::size_t windows) noexcept;

}  // namespace twin::shadow
