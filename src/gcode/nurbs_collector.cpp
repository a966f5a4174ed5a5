#include "gcode/nurbs_collector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "gcode/lexer.hpp"
#include "gcode/line_words.hpp"
#include "gcode/modal_state.hpp"

namespace twin::gcode {
namespace {

constexpr std::string_view kAxisLetters = "XYZ";
constexpr double kApart = 1e-3;  // of the first control point and the position before [mm]

}  // namespace

Expected<void> NurbsCollector::open(const LineWords& words, const ModalState& state,
                                    const Vec3& position, std::int64_t line) {
  has_knots_ = state.motion == MotionMode::kKnotNurbs;
  line_ = line;
  column_ = words.column(GGroup::kMotion);
  if (auto checked = check_start(words, state); !checked) {
    return checked;
  }
  is_open_ = true;
  is_past_points_ = lacks_first_knot_ = false;
  knots_.clear();
  points_.assign(1, position);
  weights_.assign(1, 1.0);
  return has_knots_ ? start_with_knots(words, state) : add_uniform(words, state, true);
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
  return has_knots_ ? add_with_knot(words, state) : add_uniform(words, state, false);
}

bool NurbsCollector::is_complete() const noexcept {
  return has_knots_ && is_open_ && knots_.size() == points_.size() + order_;
}

Expected<std::shared_ptr<const ProgrammedCurve>> NurbsCollector::close(int column) {
  is_open_ = false;
  if (points_.size() < order_) {
    return too_few(column);
  }
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

Expected<void> NurbsCollector::add_uniform(const LineWords& words, const ModalState& state,
                                           bool is_first) {
  if (auto checked = check_letters(words, is_first ? "FLNPSTXY" : "NPXY"); !checked) {
    return checked;
  }
  if (is_first) {
    if (auto set = set_order(words, 'L', 3, 3); !set) {
      return set;
    }
  }
  if (words.has('X') != words.has('Y')) {
    return fail_at(words.first_column(kAxisLetters), "a control point of G05.2 needs both X and Y");
  }
  if (words.has('X')) {
    return add_point(words, state, 'P');
  }
  if (words.has('P') && !is_first) {
    return fail_at(words.column('P'),
                   "P without X and Y: expected that beside G05.2 only, where it is the weight of "
                   "the position before");
  }
  return set_weight(words, 'P');
}

Expected<void> NurbsCollector::start_with_knots(const LineWords& words, const ModalState& state) {
  if (auto checked = check_letters(words, "FKNPRSTXYZ"); !checked) {
    return checked;
  }
  if (auto set = set_order(words, 'P', 2, 4); !set) {
    return set;
  }
  if (words.has_any(kAxisLetters)) {
    const double apart = (place_of(words, state) - points_.front()).norm();
    if (!(apart <= kApart)) {
      return fail_at(words.first_column(kAxisLetters),
                     fmt::format("the first control point is {:.4g} mm away from the position "
                                 "before: expected the same place",
                                 apart));
    }
  }
  if (auto set = set_weight(words, 'R'); !set) {
    return set;
  }
  lacks_first_knot_ = !words.has('K');
  if (lacks_first_knot_ && words.has_any("XYZR")) {
    return fail_at(words.first_column("XYZR"), "no knot: expected a K word with the control point");
  }
  return lacks_first_knot_ ? Expected<void>{} : add_knot(words.value('K'), words.column('K'));
}

Expected<void> NurbsCollector::add_with_knot(const LineWords& words, const ModalState& state) {
  if (auto checked = check_letters(words, "KNRXYZ"); !checked) {
    return checked;
  }
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
    if (auto added = add_point(words, state, 'R'); !added) {
      return added;
    }
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

}  // namespace twin::gcode
