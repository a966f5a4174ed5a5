#pragma once

#include <cstddef>
#include <vector>

#include "shadow/count_filter.hpp"

namespace twin::shadow {

/// A force of 1 N that begins at one instant, in sums over the rows since then.
struct Onset {
  double score = 0.0;        ///< h_o = sum z_o g
  double information = 0.0;  ///< G_oo = sum w z_o^2
  PerParameter cross{};      ///< G_oi = sum w z_o z_i

  /// Twice the logarithm of the likelihood that the best force gains.
  double explained() const noexcept {
    return information > 0.0 ? score * score / information : 0.0;
  }
};

/// Follows what forces that begin at any time would leave in the rows of a CountFilter.
///
/// A force on a drive with an integral moves it by some micrometres and is then made up for, so that
/// it shows where it begins. Every kEvery periods one is supposed to begin; what it does to the
/// position, s_o, passes the same filter as signatures do, for kLasts periods.
class OnsetBank {
 public:
  static constexpr std::size_t kEvery = 10;
  static constexpr std::size_t kLasts = 300;

  /// @param response  of the position to 1 N, period by period; at least kLasts values. Allocates.
  explicit OnsetBank(std::vector<double> response);

  /// Real-time safe.
  void step(const CountFilter::Row& row) noexcept;
  /// The best of those that began within `periods` from `ago` periods ago on, the row just taken
  /// being 0. Real-time safe.
  Onset best(std::size_t ago, std::size_t periods) const noexcept;

 private:
  struct Slot {
    Onset onset;
    CountFilter::State state{};
    std::size_t age = kLasts;  // kLasts: it is over
  };
  std::vector<double> response_;
  std::vector<Slot> slots_;  // a ring
  std::size_t next_ = 0;
  std::size_t since_ = 0;
};

}  // namespace twin::shadow
