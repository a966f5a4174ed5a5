#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/block.hpp"

namespace twin::gcode {

class Coordinates;
class LineWords;
struct ModalState;

/// Collects the lines of one NURBS.
///
///     G05.2 [X- Y-] [P-] [L-]      P weight, 1 if left out; L order 3 to 6, 3 if left out
///     X- Y- [P-]                   order = degree + 1
///     ...
///     G05.3
///
/// The position before G05.2 is the first control point; G05.2 P- without X and Y gives its weight.
/// With the N control points and the order k go the knots 0 (k times), 1, 2, ..., N - k, N - k + 1
/// (k times). The letters are those of the plane: X Y, Z X or Y Z. A second control point at the
/// position would leave the curve without a tangent at its start; it is moved by kNudge. Source: LinuxCNC, G-Code manual, "G5.2 G5.3 NURBS Block"; the knots
/// from the points its interpreter (`rs274` 2.9) makes.
///
///     G06.2 [P-] K- X- Y- Z- [R-]  P rank 2 to 6, 4 if left out; rank = degree + 1
///     K- X- Y- Z- [R-]             one control point a line: K its knot, R its weight, 1 if left
///     ...                          out; an axis left out keeps its place
///     K-                           as many lines of a knot alone as the rank
///     [G06.3]
///
/// Each closing line may repeat G06.2, and the first line may have Q and L, which choose between
/// ways to follow the curve and do not change it: so does LinuxCNC write it.
/// The first control point is the position before. The first line need not name its axes, nor its K
/// then, which is the knot of the second line. The first and the last knot must each occur as often
/// as the rank. The last knot ends the curve; G06.3 after it is LinuxCNC's. Source: FANUC Series
/// 15i/150i-MA operator's manual (programming), "NURBS interpolation (G06.2)"; FANUC has rank 2 to
/// 4.
///
/// Both need G90, G64 and a feedrate, and every word that is not named here is refused.
class NurbsCollector {
 public:
  static constexpr std::size_t kMostPoints = 100000;  ///< control points of one curve
  static constexpr double kFarthest = 1e5;            ///< largest coordinate [mm]
  static constexpr double kLeastWeight = 1e-4;        ///< of a control point
  static constexpr double kMostWeight = 1e4;          ///< the same
  static constexpr double kNudge = 1e-3;              ///< of a control point at the position [mm]

  bool is_open() const noexcept { return is_open_; }

  /// Takes the line with G05.2 or G06.2, which may hold a control point.
  ///
  /// @param state     modal state with the line's own words in force
  /// @param position  place before the line [mm]
  Expected<void> open(const LineWords& words, const ModalState& state, const Vec3& position,
                      std::int64_t line);
  /// Takes a further line.
  Expected<void> add(const LineWords& words, const ModalState& state);
  /// True behind the last knot of G06.2.
  bool is_complete() const noexcept;
  /// Whether a line with G06.2 inside a G06.2 goes on with it: a knot and nothing else.
  bool takes_closing_line(const LineWords& words) const noexcept;
  /// Whether a control point was moved by kNudge.
  bool is_nudged() const noexcept { return is_nudged_; }
  /// The last control point so far [mm].
  const Vec3& last_point() const noexcept { return points_.back(); }

  /// Ends the NURBS, brings it to the machine and measures it.
  ///
  /// @param column  of the word which ends it
  /// @param start   where the machine is [mm]
  Expected<std::shared_ptr<const ProgrammedCurve>> close(int column, const Coordinates& frame,
                                                         const Vec3& start);

  /// The error of a NURBS that something else cuts short, at the place where it began.
  ///
  /// @param reason  as in "the program ends"
  Error cut_short(std::string_view reason) const;

  std::int64_t line() const noexcept { return line_; }  ///< where it began
  std::string_view name() const noexcept { return has_knots_ ? "G06.2" : "G05.2"; }

 private:
  Expected<void> check_start(const LineWords& words, const ModalState& state) const;
  Expected<void> check_letters(const LineWords& words, std::string_view allowed) const;
  Expected<void> set_order(const LineWords& words, char letter, std::size_t least,
                           std::size_t if_missing);
  Expected<void> start_uniform(const LineWords& words, const ModalState& state);
  Expected<void> add_uniform(const LineWords& words, const ModalState& state);
  Expected<void> add_uniform_point(const LineWords& words, const ModalState& state);
  Expected<void> start_with_knots(const LineWords& words, const ModalState& state);
  Expected<void> add_with_knot(const LineWords& words, const ModalState& state);
  Expected<void> add_point(const LineWords& words, const ModalState& state, char weight);
  Expected<void> set_weight(const LineWords& words, char letter);
  Expected<void> add_knot(double knot, int column);
  tl::unexpected<Error> too_few(int column) const;
  void nudge();
  Vec3 place_of(const LineWords& words, const ModalState& state) const;
  std::vector<double> uniform_knots() const;

  bool is_open_ = false;
  bool has_knots_ = false;  // G06.2
  bool is_nudged_ = false;
  std::string_view plane_letters_ = "XY";  // of G05.2
  std::size_t order_ = 0;
  std::vector<double> knots_;
  std::vector<Vec3> points_;
  std::vector<double> weights_;
  bool is_past_points_ = false;  // only knots may follow
  bool lacks_first_knot_ = false;
  std::int64_t line_ = 0;
  int column_ = 0;
};

}  // namespace twin::gcode
