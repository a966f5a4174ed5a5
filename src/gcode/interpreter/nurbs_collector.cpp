#include "gcode/interpreter/nurbs_collector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gcode/interpreter/coordinates.hpp"
#include "gcode/interpreter/modal_state.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/words/line_words.hpp"
#include "geometry/nurbs/knot_vector.hpp"

namespace twin::gcode {
namespace {

constexpr std::size_t kMostOrder = geometry::kMaxDegree + 1;
constexpr std::string_view kAxisLetters = "XYZ";
constexpr double kApart = 1e-3;  // of the first control point and the position before [mm]

std::string_view letters_of(Plane plane) {
  switch (plane) {
    case Plane::kZx:
      return "ZX";
    case Plane::kYz:
      return "YZ";
    default:
      return "XY";
  }
}

}  // namespace

Expected<void> NurbsCollector::open(const LineWords& words, const ModalState& state,
                                    const Vec3& position, std::int64_t line) {
  has_knots_ = state.motion == MotionMode::kKnotNurbs;
  line_ = line;
  column_ = words.column(GGroup::kMotion);
  TWIN_CHECK(check_start(words, state));
  is_open_ = true;
  is_past_points_ = lacks_first_knot_ = is_nudged_ = false;
  plane_letters_ = letters_of(state.plane);
  knots_.clear();
  points_.assign(1, position);
  weights_.assign(1, 1.0);
  return has_knots_ ? start_with_knots(words, state) : start_uniform(words, state);
}

Expected<void> NurbsCollector::add(const LineWords& words, const ModalState& state) {
  for (std::size_t group = 0; group < kGGroups; ++group) {
    const auto g = static_cast<GGroup>(group);
    if (words.has(g) && g != GGroup::kMotion) {
      return fail_at(words.column(g),
                     fmt::format("a G word within the {} of line {}: expected it before or behind "
                                 "the NURBS",
                                 name(), line_));
    }
  }
  return has_knots_ ? add_with_knot(words, state) : add_uniform(words, state);
}

bool NurbsCollector::is_complete() const noexcept {
  return has_knots_ && is_open_ && knots_.size() == points_.size() + order_;
}

bool NurbsCollector::takes_closing_line(const LineWords& words) const noexcept {
  return has_knots_ && words.has('K') && !words.has_any("XYZRPQL");
}

/// Moves a second control point that is the first one towards the next.
void NurbsCollector::nudge() {
  if (has_knots_ || points_.size() < 3 || (points_[1] - points_[0]).norm() > kNoLength) {
    return;
  }
  const Vec3 ahead = points_[2] - points_[0];
  if (ahead.norm() > 2.0 * kNudge) {
    points_[1] = points_[0] + kNudge * ahead.normalized();
    is_nudged_ = true;
  }
}

Expected<std::shared_ptr<const ProgrammedCurve>> NurbsCollector::close(int column,
                                                                       const Coordinates& frame,
                                                                       const Vec3& start) {
  is_open_ = false;
  if (points_.size() < order_) {
    return too_few(column);
  }
  for (Vec3& point : points_) {
    point = frame.machine_of(point);
  }
  points_.front() = start;
  nudge();
  std::vector<double> knots = has_knots_ ? std::move(knots_) : uniform_knots();
  auto curve = geometry::Curve::create(static_cast<int>(order_) - 1, std::move(knots),
                                       std::move(points_), std::move(weights_));
  if (!curve) {
    return fail_at(column, std::move(curve.error().message));
  }
  auto made = make_programmed_curve(std::move(*curve));
  if (!made) {
    return fail_at(column, std::move(made.error().message));
  }
  return made;
}

tl::unexpected<Error> NurbsCollector::too_few(int column) const {
  return fail_at(column, fmt::format("{} control points, the position before the {} of line {} "
                                     "among them: expected {} or more for that order",
                                     points_.size(), name(), line_, order_));
}

Error NurbsCollector::cut_short(std::string_view reason) const {
  std::string found = "no G05.3";
  if (has_knots_) {
    found =
        fmt::format("{} control points of rank {} and {} knots, which is {} too few",
                    points_.size(), order_, knots_.size(), points_.size() + order_ - knots_.size());
  }
  Error error{ErrorCode::kProgram,
              fmt::format("the {} that begins here has {} where {}", name(), found, reason),
              {},
              0,
              column_};
  error.line = static_cast<int>(std::min<std::int64_t>(line_, std::numeric_limits<int>::max()));
  return error;
}

Expected<void> NurbsCollector::start_uniform(const LineWords& words, const ModalState& state) {
  TWIN_CHECK(check_letters(words, plane_letters_ == "XY"   ? "FLNPSTXY"
                                  : plane_letters_ == "ZX" ? "FLNPSTXZ"
                                                           : "FLNPSTYZ"));
  TWIN_CHECK(set_order(words, 'L', 3, 3));
  return add_uniform_point(words, state);
}

Expected<void> NurbsCollector::add_uniform(const LineWords& words, const ModalState& state) {
  TWIN_CHECK(check_letters(words, plane_letters_ == "XY"   ? "NPXY"
                                  : plane_letters_ == "ZX" ? "NPXZ"
                                                           : "NPYZ"));
  if (words.has('P') && !words.has_any(kAxisLetters)) {
    return fail_at(words.column('P'),
                   fmt::format("P without {} and {}: expected that beside G05.2 only, where it is "
                               "the weight of the position before",
                               plane_letters_[0], plane_letters_[1]));
  }
  return add_uniform_point(words, state);
}

/// The control point of a line, or the weight of the last one.
Expected<void> NurbsCollector::add_uniform_point(const LineWords& words, const ModalState& state) {
  const bool has_first = words.has(plane_letters_[0]);
  if (has_first != words.has(plane_letters_[1])) {
    return fail_at(words.first_column(kAxisLetters),
                   fmt::format("a control point of G05.2 needs both {} and {}", plane_letters_[0],
                               plane_letters_[1]));
  }
  return has_first ? add_point(words, state, 'P') : set_weight(words, 'P');
}

Expected<void> NurbsCollector::start_with_knots(const LineWords& words, const ModalState& state) {
  TWIN_CHECK(check_letters(words, "FKLNPQRSTXYZ"));
  TWIN_CHECK(set_order(words, 'P', 2, 4));
  if (words.has_any(kAxisLetters)) {
    const double apart = (place_of(words, state) - points_.front()).norm();
    if (!(apart <= kApart)) {
      return fail_at(words.first_column(kAxisLetters),
                     fmt::format("the first control point is {:.4g} mm away from the position "
                                 "before: expected the same place",
                                 apart));
    }
  }
  TWIN_CHECK(set_weight(words, 'R'));
  lacks_first_knot_ = !words.has('K');
  if (lacks_first_knot_ && words.has_any("XYZR")) {
    return fail_at(words.first_column("XYZR"), "no knot: expected a K word with the control point");
  }
  return lacks_first_knot_ ? Expected<void>{} : add_knot(words.value('K'), words.column('K'));
}

Expected<void> NurbsCollector::add_with_knot(const LineWords& words, const ModalState& state) {
  TWIN_CHECK(check_letters(words, "KNRXYZ"));
  if (!words.has('K')) {
    return words.has_any("XYZR") ? fail_at(words.first_column("XYZR"),
                                           "no knot: expected a K word with the control point")
                                 : Expected<void>{};
  }
  if (lacks_first_knot_) {
    lacks_first_knot_ = false;
    knots_.push_back(words.value('K'));
  }
  if (words.has_any(kAxisLetters)) {
    if (is_past_points_) {
      return fail_at(words.first_column(kAxisLetters),
                     "a control point behind a knot alone: expected knots to the end");
    }
    TWIN_CHECK(add_point(words, state, 'R'));
  } else if (words.has('R')) {
    return fail_at(words.column('R'), "a weight without a control point: expected X, Y or Z");
  } else if (points_.size() < order_) {
    return too_few(words.column('K'));
  } else {
    is_past_points_ = true;
  }
  return add_knot(words.value('K'), words.column('K'));
}

Expected<void> NurbsCollector::add_point(const LineWords& words, const ModalState& state,
                                         char weight) {
  const Vec3 place = place_of(words, state);
  if (points_.size() >= kMostPoints) {
    return fail_at(words.first_column(kAxisLetters),
                   fmt::format("more than {} control points in one NURBS", kMostPoints));
  }
  if (!(place.cwiseAbs().maxCoeff() <= kFarthest)) {
    return fail_at(words.first_column(kAxisLetters),
                   fmt::format("a control point farther than {:g} mm from the origin", kFarthest));
  }
  points_.push_back(place);
  weights_.push_back(1.0);
  return set_weight(words, weight);
}

Vec3 NurbsCollector::place_of(const LineWords& words, const ModalState& state) const {
  Vec3 place = points_.back();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = kAxisLetters[static_cast<std::size_t>(axis)];
    if (words.has(letter)) {
      place[axis] = words.value(letter) * state.unit;
    }
  }
  return place;
}

std::vector<double> NurbsCollector::uniform_knots() const {
  std::vector<double> knots(order_, 0.0);
  const std::size_t last = points_.size() - order_ + 1;
  for (std::size_t k = 1; k < last; ++k) {
    knots.push_back(static_cast<double>(k));
  }
  knots.insert(knots.end(), order_, static_cast<double>(last));
  return knots;
}

Expected<void> NurbsCollector::add_knot(double knot, int column) {
  const std::size_t i = knots_.size();
  const auto fault = [&](std::string_view expected) {
    return fail_at(column, fmt::format("knot K{:.10g}, number {} of rank {}: expected {}", knot,
                                       i + 1, order_, expected));
  };
  if (i > 0 && knot < knots_.back()) {
    return fault(fmt::format("not less than the one before it, K{:.10g}", knots_.back()));
  }
  if (i > 0 && i < order_ && knot != knots_.front()) {
    return fault(fmt::format("K{:.10g}, for the first knot occurs as often as the rank says",
                             knots_.front()));
  }
  if (is_past_points_ && i > points_.size() && knot != knots_.back()) {
    return fault(
        fmt::format("K{:.10g}, for the last knot occurs as often as the rank says", knots_.back()));
  }
  const std::size_t most = order_ - (is_past_points_ ? order_ - 1 : 1);  // like knots before it
  if (i >= order_ && (!is_past_points_ || i == points_.size()) && knot == knots_[i - most]) {
    return fault("a greater one, for that knot is there as often as it may be");
  }
  knots_.push_back(knot);
  return {};
}

Expected<void> NurbsCollector::check_start(const LineWords& words, const ModalState& state) const {
  const auto refuse = [&](std::string_view reason) {
    return fail_at(column_, fmt::format("{} {}", name(), reason));
  };
  if (state.is_incremental) {
    return refuse("with G91 in force: expected G90, absolute control points");
  }
  if (state.path_mode == PathMode::kExactStop) {
    return refuse("with G61 (exact stop) in force: expected G64");
  }
  if (!(state.feedrate > 0.0)) {
    return refuse("has no feedrate: expected an F word on this line or before it");
  }
  if (words.has(GGroup::kDwell)) {
    return refuse("beside G04: expected them on lines of their own");
  }
  return {};
}

Expected<void> NurbsCollector::check_letters(const LineWords& words,
                                             std::string_view allowed) const {
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (words.has(letter) && allowed.find(letter) == std::string_view::npos) {
      return fail_at(words.column(letter),
                     fmt::format("{} does not belong on this line of the {} of line {}", letter,
                                 name(), line_));
    }
  }
  return {};
}

/// Order, which is degree + 1; FANUC calls it the rank.
Expected<void> NurbsCollector::set_order(const LineWords& words, char letter, std::size_t least,
                                         std::size_t if_missing) {
  order_ = if_missing;
  if (words.has(letter)) {
    const double order = words.value(letter);
    if (!(order >= static_cast<double>(least) && order <= static_cast<double>(kMostOrder)) ||
        order != std::floor(order)) {
      return fail_at(
          words.column(letter),
          fmt::format("{}{:.10g} (order, degree + 1): expected a whole number from {} to "
                      "{}",
                      letter, order, least, kMostOrder));
    }
    order_ = static_cast<std::size_t>(order);
  }
  return {};
}

/// Weight of the last control point.
Expected<void> NurbsCollector::set_weight(const LineWords& words, char letter) {
  if (words.has(letter)) {
    const double weight = words.value(letter);
    if (!(weight >= kLeastWeight && weight <= kMostWeight)) {
      return fail_at(words.column(letter), fmt::format("weight {}{:.10g}: expected {:g} to {:g}",
                                                       letter, weight, kLeastWeight, kMostWeight));
    }
    weights_.back() = weight;
  }
  return {};
}

}  // namespace twin::gcode
