#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "feedrate/certified/glide.hpp"
#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// A Glide over a path with passages of corners (path::CornerMotion), zones that are passed without
/// acceleration.
///
///   limit ------.           .---------.           .-------
///                \.________/           \.________/
///   feed  ______  hold       ___________  hold       _____
///              \__________/              \__________/
///               passage 1                 passage 2
///
/// Each passage has a feedrate; between two of them the feedrate is planned by Glide, from the end of
/// the one to the begin of the other, without acceleration at both. The feedrate of a passage is its
/// limit, or less where there is no room for a ramp from the passage before or to the one after:
/// first from the last passage back to the first, then forward. A passage that would be passed at
/// no more than its held_above is none: the feedrate may change in it, within its own acceleration
/// and jerk, up to held_above. So is the one at the place where the plan begins at rest or ends.
/// From rest there is always a plan, since all passages can become slow.
///
/// The path is built so that every passage at its full feedrate leaves room for what follows
/// (path/corner/corner_fit.hpp). So what a plan says of the passages before the first one that the
/// end of the plan slows down is final.
class PassageGlide {
 public:
  /// As Glide::plan().
  bool plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end,
            const RampLimits& ramp);

  const std::vector<Phase>& phases() const noexcept {
    return has_passages_ ? phases_ : glide_.phases();
  }
  const std::vector<Glide::Part>& parts() const noexcept {
    return has_passages_ ? parts_ : glide_.parts();
  }
  const std::vector<double>& leg_ends() const noexcept {
    return has_passages_ ? leg_ends_ : glide_.leg_ends();
  }
  bool is_even() const noexcept { return has_passages_ ? is_even_ : glide_.is_even(); }

  /// Begin of the first passage that is slower because the plan ends, or the end of the plan [mm].
  double free_end() const noexcept { return free_end_; }
  /// The last part that begins before free_end().
  std::size_t last_free_part() const noexcept;
  /// The first phase after the last passage that ends before free_end(); 0 where there is none.
  std::size_t first_after_passage() const noexcept { return first_after_passage_; }

 private:
  /// A passage that is held.
  struct Held {
    std::size_t zone;
    double v;        // [mm/s]
    bool is_slowed;  // because the plan ends
    bool is_start;   // the plan starts within it
  };

  void find_passages(const Anchor& start, const Anchor& end);
  Anchor begin_of(std::size_t held, const Anchor& end) const;
  Anchor end_of(std::size_t held, const Anchor& start) const;
  std::span<const LimitZone> zones_between(const Anchor& from, const Anchor& to) const;
  double reach(double v, const Anchor& from, const Anchor& to, double most);
  bool slow_down_backward(const Anchor& start, const Anchor& end);
  bool slow_down_forward(const Anchor& start, const Anchor& end);
  bool make_slow(std::size_t held, bool is_by_end);
  bool compose(const Anchor& start, const Anchor& end);
  void append_glide();

  RampLimits ramp_{};
  bool has_passages_ = false;
  Glide glide_;
  std::vector<LimitZone> zones_;
  std::vector<Held> held_;
  std::vector<Phase> phases_;
  std::vector<Glide::Part> parts_;
  std::vector<double> leg_ends_;
  bool is_even_ = false;
  double free_end_ = std::numeric_limits<double>::infinity();
  std::size_t first_after_passage_ = 0;
};

}  // namespace twin::feedrate
