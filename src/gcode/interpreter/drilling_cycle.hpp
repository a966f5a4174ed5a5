#pragma once

#include <cstdint>
#include <optional>

#include "core/vec.hpp"
#include "gcode/interpreter/plane.hpp"

namespace twin::gcode {

/// What a canned cycle does at the bottom of the hole and on its way there and back.
enum class CycleKind : std::uint8_t {
  kDrill,      ///< G81: feed down, rapid out
  kDwell,      ///< G82: feed down, rest, rapid out
  kPeck,       ///< G83: in steps of Q, each time out to R
  kChipBreak,  ///< G73: in steps of Q, each time back by kClearance
  kTap,        ///< G74, G84: feed down, rest, feed out
  kFeedOut,    ///< G85: feed down, feed out to R
  kBore,       ///< G86: feed down, rest, rapid out
  kDwellFeed,  ///< G89: feed down, rest, feed out
};

/// The numbers of one line with a canned cycle, in the coordinates of the program [mm]. "Up" is
/// along the third axis of the plane.
struct CycleLine {
  CycleKind kind = CycleKind::kDrill;
  Plane plane = Plane::kXy;
  Vec3 first = Vec3::Zero();  ///< place of the first hole; its third axis is not used
  Vec3 step = Vec3::Zero();   ///< from hole to hole, in the plane
  /// From hole to hole about the origin instead: a distance [mm] and an angle [rad].
  std::optional<Vec2> polar_step{};
  std::int64_t repeats = 1;         ///< holes
  double initial = 0.0;             ///< height at which the series of cycles began
  double retract = 0.0;             ///< R
  double bottom = 0.0;              ///< Z, not above R
  double peck = 0.0;                ///< Q, above zero for kPeck and kChipBreak
  double dwell = 0.0;               ///< P [s]
  bool returns_to_retract = false;  ///< G99; G98 returns to `initial` where that is higher
};

/// One move of a canned cycle.
struct CycleMove {
  enum class Kind : std::uint8_t { kRapid, kFeed, kRest };
  Kind kind = Kind::kRapid;
  Vec3 place = Vec3::Zero();  ///< where it leads, in the coordinates of the program [mm]
  double rest = 0.0;          ///< time [s]
};

/// The moves of a line with a canned cycle, one at a time.
///
///   above R at the start:      below R at the start:
///   rapid to the hole          rapid up to R, then the same
///   rapid down to R
///   the feed moves of the kind, down to Z
///   out to the clear height: the initial one, or R
/// Every hole begins at the clear height of the one before it, or above. Source: LinuxCNC, G-Code manual,
/// "G80-G89 Canned Cycles".
class DrillingCycle {
 public:
  static constexpr double kClearance = 0.254;  ///< back from the bottom between pecks [mm]

  /// Nothing to do.
  DrillingCycle() = default;
  /// @param place  where the tool is, in the coordinates of the program [mm]
  DrillingCycle(const CycleLine& line, const Vec3& place);

  /// The next move, which may have no length; nullopt at the end.
  std::optional<CycleMove> next();
  bool is_done() const noexcept { return stage_ == Stage::kDone; }

 private:
  enum class Stage : std::uint8_t {
    kToRetract,  // up to R before the first hole
    kToHole,
    kDown,
    kFeed,
    kBack,   // out of the hole between pecks
    kAgain,  // into it again
    kRest,
    kFeedOut,
    kOut,
    kDone
  };
  CycleMove to(CycleMove::Kind kind, double height, Stage then);
  CycleMove peck(Stage then_if_not_done);
  Stage at_bottom() const noexcept;
  CycleMove leave(CycleMove::Kind kind);
  double clear() const noexcept;

  CycleLine line_;
  Eigen::Index up_ = 2;
  Vec3 place_ = Vec3::Zero();
  Vec3 hole_ = Vec3::Zero();
  double depth_ = 0.0;  // reached in the hole
  std::int64_t left_ = 0;
  Stage stage_ = Stage::kDone;
};

}  // namespace twin::gcode
