#include "gcode/interpreter/polar_words.hpp"

#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "gcode/interpreter/line_check.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

constexpr double kInRadians = std::numbers::pi / 180.0;

Expected<void> check_polar(const LineWords& words, const ModalState& state) {
  const int column = words.first_column(kPolarLetters);
  if (words.has_any("XY")) {
    return fail_at(column, "@ or ^ beside X or Y: expected one of them");
  }
  if (words.has(GGroup::kPlane) ? words.g(GGroup::kPlane) != GWord::kPlaneXy
                                : state.plane != Plane::kXy) {
    return fail_at(column, "@ and ^ are polar coordinates of X and Y: expected G17");
  }
  if (sets_by_axes(words) || words.has(GGroup::kMachineCoordinates) || state.is_polar ||
      words.has(GGroup::kPolar) || state.is_nurbs()) {
    return fail_at(column,
                   "@ and ^ are places that a move leads to: expected no G10, G16, G28, "
                   "G53, G92 or NURBS beside them");
  }
  return {};
}

}  // namespace

Expected<void> polar_to_axes(LineWords& words, const ModalState& state, const Vec3& place) {
  TWIN_CHECK(check_polar(words, state));
  const int column = words.first_column(kPolarLetters);
  const bool is_incremental = words.has(GGroup::kDistance)
                                  ? words.g(GGroup::kDistance) == GWord::kIncremental
                                  : state.is_incremental;
  const double unit = !words.has(GGroup::kUnits)                ? state.unit
                      : words.g(GGroup::kUnits) == GWord::kInch ? units::kMmPerInch
                                                                : 1.0;
  double radius = std::hypot(place.x(), place.y());
  double angle = std::atan2(place.y(), place.x());
  if (is_incremental) {
    if (radius == 0.0) {
      return fail_at(column, "@ or ^ with G91 at the origin, which has no angle: expected G90");
    }
    radius += words.value_or_zero(kPolarRadius) * unit;
    angle += words.value_or_zero(kPolarAngle) * kInRadians;
  } else {
    radius = words.has(kPolarRadius) ? words.value(kPolarRadius) * unit : radius;
    angle = words.has(kPolarAngle) ? words.value(kPolarAngle) * kInRadians : angle;
  }
  const Vec2 from = is_incremental ? Vec2(place.head<2>()) : Vec2(Vec2::Zero());
  words.set('X', (radius * std::cos(angle) - from.x()) / unit, column);
  words.set('Y', (radius * std::sin(angle) - from.y()) / unit, column);
  return {};
}

}  // namespace twin::gcode
