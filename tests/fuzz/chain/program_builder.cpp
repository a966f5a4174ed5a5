#include "tests/fuzz/chain/program_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>

namespace twin::fuzz {
namespace {

constexpr double kInch = 25.4;     // [mm]
constexpr double kNothing = 1e-6;  // shorter moves are not written [mm]
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr const char* kChaff[] = {"(a comment)",     "N7", "/X150 Y150", "S1000 M3",
                                  "M01 ; passes by", "",   "G40 G49 G54"};

std::array<int, 3> axes_of(ProgramBuilder::Plane plane) {
  switch (plane) {
    case ProgramBuilder::Plane::kXy:
      return {0, 1, 2};
    case ProgramBuilder::Plane::kZx:
      return {2, 0, 1};
    default:
      return {1, 2, 0};
  }
}

/// Centre of the arc of a radius between two points of a plane: at the right of the way for a
/// clockwise arc of less than a half turn.
Vec2 centre_by_radius(const Vec2& from, const Vec2& to, double radius, bool is_right) {
  const Vec2 way = to - from;
  const double off = std::sqrt(std::max(radius * radius / way.squaredNorm() - 0.25, 0.0));
  return 0.5 * (from + to) + (is_right ? off : -off) * Vec2(way.y(), -way.x());
}

/// Weights of NURBS as they are read: rounded.
double rounded(double value) { return std::strtod(fmt::format("{:.6f}", value).c_str(), nullptr); }

}  // namespace

void ProgramBuilder::write(const std::string& text) {
  program_.text += text + "\n";
  ++lines_;
}

/// What is read again of a length that is written.
double ProgramBuilder::number(double mm) const {
  return is_inch_ ? rounded(mm / kInch) * kInch : rounded(mm);
}

std::string ProgramBuilder::word(char letter, double mm) {
  return fmt::format("{}{:.6f}", letter, is_inch_ ? mm / kInch : mm);
}

std::string ProgramBuilder::axis_word(int axis, double to, Vec3& end) {
  const double from = is_incremental_ ? position_[axis] : 0.0;
  end[axis] = from + number(to - from);
  return word("XYZ"[axis], to - from);
}

/// Words of the axes that move; `end` becomes the place that they say.
std::string ProgramBuilder::words_to(Vec3& end) {
  std::string words;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(end[axis] - position_[axis]) > kNothing) {
      words += " " + axis_word(axis, end[axis], end);
    } else {
      end[axis] = position_[axis];
    }
  }
  return words;
}

void ProgramBuilder::add(Shape shape, bool is_rapid) {
  position_ = shape.points.back();
  program_.pieces.push_back({.shape = std::move(shape),
                             .feedrate = is_rapid ? rapid_feedrate_ : feedrate_,
                             .tolerance = tolerance_,
                             .dwell = 0.0,
                             .is_exact = is_exact_,
                             .line = lines_});
}

void ProgramBuilder::set_feedrate(double feedrate) {
  feedrate_ = std::max(number(feedrate * 60.0), 0.01) / 60.0;
  write(word('F', feedrate_ * 60.0));
}

void ProgramBuilder::set_plane(Plane plane) {
  plane_ = plane;
  write(plane == Plane::kXy ? "G17" : plane == Plane::kZx ? "G18" : "G19");
}

void ProgramBuilder::set_inches(bool is_inch) {
  is_inch_ = is_inch;
  write(is_inch ? "G20" : "G21");
}

void ProgramBuilder::set_incremental(bool is_incremental) {
  is_incremental_ = is_incremental;
  write(is_incremental ? "G91" : "G90");
}

void ProgramBuilder::set_continuous(double tolerance) {
  is_exact_ = false;
  tolerance_ = number(tolerance);
  write(tolerance_ > 0.0 ? "G64 " + word('P', tolerance) : "G64");
}

void ProgramBuilder::set_exact_stop() {
  is_exact_ = true;
  tolerance_ = 0.0;
  write("G61");
}

void ProgramBuilder::add_chaff(std::size_t which) { write(kChaff[which % std::size(kChaff)]); }

void ProgramBuilder::rest(double duration) {
  write(duration > 0.0 ? fmt::format("G04 P{:.6f}", duration) : "M00");
  add({{position_}, 0.0, 0.0}, false);
  program_.pieces.back().dwell = rounded(duration);
}

void ProgramBuilder::line_to(const Vec3& end, bool is_rapid) {
  Vec3 to = end;
  const std::string words = words_to(to);
  if ((to - position_).norm() < kNothing) {
    return;
  }
  write((is_rapid ? "G00" : "G01") + words);
  add(line_shape(position_, to), is_rapid);
}

void ProgramBuilder::arc(const Vec2& centre, double sweep, double rise, bool by_radius) {
  const auto [first, second, third] = axes_of(plane_);
  Vec3 middle = position_;
  middle[first] += number(centre.x());
  middle[second] += number(centre.y());
  const double radius = centre.norm();
  const bool is_full = std::abs(sweep) >= kFullTurn;
  Vec3 end = position_;
  if (!is_full) {
    const double angle = std::atan2(-centre.y(), -centre.x()) + sweep;
    end[first] = middle[first] + radius * std::cos(angle);
    end[second] = middle[second] + radius * std::sin(angle);
  }
  end[third] += rise;
  const double turn = std::abs(sweep);
  if (radius < 1e-3 || turn * radius < 1e-2 || (!is_full && (kFullTurn - turn) * radius < 1e-2)) {
    return;  // too small to be told from a whole turn once it is rounded
  }
  const bool is_clockwise = sweep < 0.0;
  std::string words = (is_clockwise ? "G02" : "G03") + words_to(end);
  const bool is_far_from_half = (turn > 0.3 && turn < 2.8) || (turn > 3.5 && turn < 5.9);
  if (by_radius && is_far_from_half && radius > 0.1) {
    const bool is_long = turn > std::numbers::pi;
    words += " " + word('R', is_long ? -radius : radius);
    const Vec2 in_plane =
        centre_by_radius({position_[first], position_[second]}, {end[first], end[second]},
                         number(radius), is_clockwise != is_long);
    middle[first] = in_plane.x();
    middle[second] = in_plane.y();
  } else {
    words += fmt::format(" {} {}", word("IJK"[first], centre.x()), word("IJK"[second], centre.y()));
  }
  write(words);
  add(arc_shape({position_, end, middle, first, second, is_clockwise, is_full}), false);
}

void ProgramBuilder::end_nurbs(NurbsOutline nurbs, std::int64_t line) {
  add(nurbs_shape(nurbs), false);
  program_.pieces.back().line = line;
}

void ProgramBuilder::uniform_nurbs(std::size_t degree, std::vector<Vec3> points,
                                   std::vector<double> weights) {
  const std::int64_t line = lines_ + 1;
  NurbsOutline nurbs{degree, {}, {position_}, {rounded(weights.front())}};
  write(fmt::format("G05.2 P{:.6f} L{}", weights.front(), degree + 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3 end = points[i];
    end.z() = position_.z();
    const std::string x = axis_word(0, end.x(), end);
    write(fmt::format("{} {} P{:.6f}", x, axis_word(1, end.y(), end), weights[i + 1]));
    nurbs.points.push_back(end);
    nurbs.weights.push_back(rounded(weights[i + 1]));
  }
  write("G05.3");
  const std::size_t spans = nurbs.points.size() - degree;
  nurbs.knots.assign(degree, 0.0);
  for (std::size_t i = 0; i <= spans; ++i) {
    nurbs.knots.push_back(static_cast<double>(i));
  }
  nurbs.knots.insert(nurbs.knots.end(), degree, static_cast<double>(spans));
  end_nurbs(std::move(nurbs), line);
}

void ProgramBuilder::knot_nurbs(std::size_t degree, std::vector<Vec3> points,
                                std::vector<double> weights, const std::vector<double>& inner) {
  const std::int64_t line = lines_ + 1;
  NurbsOutline nurbs{
      degree, std::vector<double>(degree + 1, 0.0), {position_}, {rounded(weights.front())}};
  for (const double knot : inner) {
    nurbs.knots.push_back(rounded(knot));
  }
  nurbs.knots.insert(nurbs.knots.end(), degree + 1, 1.0);
  write(fmt::format("G06.2 P{} K0 R{:.6f}", degree + 1, weights.front()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3 end = points[i];
    std::string words = fmt::format("K{:.6f}", nurbs.knots[i + 1]);
    for (int axis = 0; axis < 3; ++axis) {
      words += " " + axis_word(axis, points[i][axis], end);
    }
    write(words + fmt::format(" R{:.6f}", weights[i + 1]));
    nurbs.points.push_back(end);
    nurbs.weights.push_back(rounded(weights[i + 1]));
  }
  for (std::size_t i = nurbs.points.size(); i < nurbs.knots.size(); ++i) {
    write(fmt::format("K{:.6f}", nurbs.knots[i]));
  }
  end_nurbs(std::move(nurbs), line);
}

MadeProgram ProgramBuilder::take() { return std::move(program_); }

}  // namespace twin::fuzz
