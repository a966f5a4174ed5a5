#include <fmt/format.h>

#include <cmath>

#include "gcode/lexer.hpp"
#include "gcode/line_words.hpp"
#include "gcode/modal_state.hpp"
#include "gcode/nurbs_collector.hpp"
#include "geometry/nurbs/knot_vector.hpp"

/// The part of NurbsCollector that looks at single words.
namespace twin::gcode {
namespace {

constexpr std::size_t kMostOrder = geometry::kMaxDegree + 1;

}  // namespace

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
  if (!has_knots_ && state.plane != Plane::kXy) {
    return refuse("outside the XY plane: expected G17");
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
