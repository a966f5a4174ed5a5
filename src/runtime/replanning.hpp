#pragma once

#include <cstdint>

#include "motion/interpolator/interpolator.hpp"

namespace twin::runtime {

/// A request of the motion to the planning for another plan of the rest of the path.
struct ReplanRequest {
  motion::PlanPlace from;   ///< where the motion is
  bool is_at_rest = false;  ///< true: the plan starts at `from`; false: at a place ahead of it
  double margin = 0.0;      ///< least time of motion from `from` to the place ahead [s]
  double percent = 100.0;   ///< feed override of the plan, > 0 [%]
};

/// The answer of the planning.
struct ReplanOffer {
  enum class Kind : std::uint8_t {
    kPlan,      ///< there is another plan, which starts at `at`
    kPathEnd,   ///< the path ends before another plan could start
    kOnlyRest,  ///< no place ahead is fit for a start: the motion has to brake to rest first
  };
  Kind kind = Kind::kPlan;
  motion::PlanSwitch at;  ///< where the other plan takes over; at rest only at.plan is used
  double distance = 0.0;  ///< distance of this place from the start of the path [mm]
};

/// What the motion does with an offer.
enum class Verdict : std::uint8_t { kRejected, kAccepted };

/// The planned path as the motion sees it. Real-time safe on the wall clock.
class PlanSupply : public motion::SegmentSource {
 public:
  /// Distance from the start of the path up to which a plan is known [mm]; infinite if the motion
  /// cannot come to the end of what is planned.
  virtual double reach(std::int64_t plan) const noexcept = 0;
  /// Whether enough is planned for the motion to start.
  virtual bool is_primed() const noexcept = 0;
};

/// The interface by which the motion asks for another plan:
///
///   ask() --> offer() is null ... --> offer() --> answer(kAccepted or kRejected)
///
/// There is one request at a time. Real-time safe on the wall clock.
class Replanning {
 public:
  Replanning() = default;
  Replanning(const Replanning&) = delete;
  Replanning& operator=(const Replanning&) = delete;
  virtual ~Replanning() = default;

  /// @returns false, with nothing asked, while an earlier request is under way
  virtual bool ask(const ReplanRequest& request) noexcept = 0;
  /// The offer, or null as long as there is none.
  virtual const ReplanOffer* offer() const noexcept = 0;
  /// Accepts or rejects the offer, which ends the request.
  virtual void answer(Verdict verdict) noexcept = 0;
  /// Says that the motion has come to this segment.
  virtual void report(std::int64_t segment) noexcept = 0;
};

}  // namespace twin::runtime
