#pragma once

#include <cstdint>

#include "motion/interpolator/interpolator.hpp"

namespace twin::runtime {

/// What the motion asks planning for: another plan of the rest of the path.
struct ReplanRequest {
  motion::PlanPlace from;   ///< where the motion is
  bool is_at_rest = false;  ///< the plan starts there; else at a place ahead
  double margin = 0.0;      ///< least time of motion from there to that place [s]
  double percent = 100.0;   ///< feed override, > 0 [%]
};

/// What planning answers.
struct ReplanOffer {
  enum class Kind : std::uint8_t {
    kPlan,      ///< another plan, from this place on
    kPathEnd,   ///< the path ends before another plan could start
    kOnlyRest,  ///< no place ahead suits: brake first
  };
  Kind kind = Kind::kPlan;
  motion::PlanSwitch at;  ///< at rest only its plan means anything
  double distance = 0.0;  ///< of this place from the path's start [mm]
};

/// What the motion does with an offer.
enum class Verdict : std::uint8_t { kRejected, kAccepted };

/// The planned path as the motion sees it. Real-time safe on the wall clock.
class PlanSupply : public motion::SegmentSource {
 public:
  /// Distance from the path's start up to which a plan is known [mm]; infinite where the motion
  /// cannot run out of it.
  virtual double reach(std::int64_t plan) const noexcept = 0;
  /// Whether so much is planned that motion may start.
  virtual bool is_primed() const noexcept = 0;
};

/// Where the motion asks for another plan: one request at a time, its answer, and the verdict on
/// it. Real-time safe on the wall clock.
class Replanning {
 public:
  Replanning() = default;
  Replanning(const Replanning&) = delete;
  Replanning& operator=(const Replanning&) = delete;
  virtual ~Replanning() = default;

  /// @returns false, with nothing asked, while an earlier request is under way
  virtual bool ask(const ReplanRequest& request) noexcept = 0;
  /// The answer, once it is there; else null.
  virtual const ReplanOffer* offer() const noexcept = 0;
  /// What is done with the answer; ends the request.
  virtual void answer(Verdict verdict) noexcept = 0;
  /// The motion has come to this segment.
  virtual void report(std::int64_t segment) noexcept = 0;
};

}  // namespace twin::runtime
