#pragma once

#include <array>
#include <cstddef>

#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// What a channel's residual says at one period: the slope and the curvature of its likelihood, and
/// what each parameter adds to the quantity that they are about.
struct WhiteRow {
  double score = 0.0;        ///< of the log-likelihood, by the residual
  double weight = 0.0;       ///< minus its second derivative, >= 0
  PerParameter signature{};  ///< z, per unit of each cause
};

/// Noise of a machine as its encoder's counts show it.
struct CountNoise {
  double walk = 0.05;   ///< standard deviation of what the model does not know, in a period [um]
  double white = 0.05;  ///< of noise in front of the encoder [um]
  double slow = 0.0;    ///< walk besides, where friction may hold the axis or not [um]
};

/// Follows the distance of a machine from its model by what each count allows.
///
/// An encoder with counts of width c that reads y says that the position is within y +- c / 2: at a
/// motion that passes many counts the edges bound it ever closer, and far closer than a mean of
/// rounded values, whose noise is c / sqrt(12). The distance x of the machine from its model is a
/// level that walks, and a hum of angle p that the model has not quite,
///   l_k = x_1 + x_2 cos p_k + x_3 sin p_k = H_k x.
/// Before period k, l is normal with mean m and variance V. With the white noise in V, the residual r
/// has the likelihood
///   Z = Phi(b) - Phi(a),   a, b = (r -+ c / 2 - m) / sqrt(V),
/// with slope g = d ln Z / dm and curvature w = -d^2 ln Z / dm^2. The normal density with the moments
/// of the product is taken on [Minka 2001]:
///   x += P H' g,   P -= P H' w H P.
/// A signature passes the same filter with the same gains, so that g and w are slope and curvature of
/// the likelihood of a change of its parameter. A filter for white noise is the limit c -> 0.
///
/// Lost counts. A jump by whole counts leaves the edges where they are and cannot be told from them
/// within a count; of all levels m + n c just one is within the counts that are read. So where m is
/// not, a second filter goes on from m + n c. Where it explains the periods that follow better, the
/// counts were lost: the second filter takes the place of the first, and the periods since then say
/// nothing. Rows are given out kDelay periods late for that.
class CountFilter {
 public:
  static constexpr std::size_t kStates = 3;
  static constexpr std::size_t kDelay = 32;  ///< periods after which a jump is decided on
  using State = std::array<double, kStates>;

  /// A row, and how a signature of the reader's own passes the filter: z = s - H x, x += gain z.
  struct Row {
    WhiteRow white;
    State observed{};        ///< H
    State gain{};            ///< P H' w
    bool has_begun = false;  ///< of motion, with this row
  };
  /// What a period has brought.
  struct Step {
    const Row* row = nullptr;     ///< of kDelay periods ago; null: there is none
    double log_likelihood = 0.0;  ///< ln Z of this period
    double jump = 0.0;            ///< of the level, that was just decided on [counts]
    double gain = 0.0;            ///< twice the logarithm of the odds for it
  };

  /// @param count  c > 0 [um]  @param hum_angle  2 pi f T of the hum; 0: there is none
  /// @param signatures  that are followed, from the first on
  CountFilter(double count, CountNoise noise, double hum_angle,
              std::size_t signatures = kParameters) noexcept;

  /// One period of motion. Real-time safe. @param direction  of the motion; 0: slow
  /// @param loose  standard deviation of a further walk of the level in this period [um]
  Step step(const SignalRow& raw, double direction, double loose) noexcept;
  /// The axis stands or something else is unknown: the level is, from now on. Real-time safe.
  void interrupt() noexcept;

 private:
  struct Follower {
    State mean{};
    std::array<State, kStates> covariance{};  // symmetric
  };
  struct Slope {
    double score = 0.0;
    double weight = 0.0;
    double log_likelihood = 0.0;
  };
  void begin(const SignalRow& raw) noexcept;
  Slope take(double residual, const State& observed, double loose, Follower& follower,
             State& gain) const noexcept;
  void suppose_jump(double residual, const State& observed, const Follower& before, double main,
                    double direction) noexcept;
  void follow_jump(double residual, const State& observed, double main, Step& step) noexcept;

  double count_;
  CountNoise noise_;
  double hum_angle_;
  std::size_t signatures_;
  double phase_ = 0.0;
  bool has_begun_ = false;
  Follower main_;
  Follower other_;        // after a jump
  double jump_ = 0.0;     // that the other one has made [counts]; 0: there is none
  double odds_ = 0.0;     // for it
  bool is_loss_ = false;  // it is against the motion
  std::size_t age_ = 0;
  std::array<State, kParameters> signature_{};
  std::array<Row, kDelay + 1> rows_{};
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace twin::shadow
