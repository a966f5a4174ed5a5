#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "tests/fuzz/chain/shape.hpp"

namespace twin::fuzz {

/// One block of a made program, as it was meant.
struct Piece {
  Shape shape;             ///< one point alone: the path rests there
  double feedrate = 0.0;   ///< programmed, or that of rapids [mm/s]
  double tolerance = 0.0;  ///< of G64 P; 0: the machine's [mm]
  double dwell = 0.0;      ///< [s]
  bool is_exact = false;   ///< G61
  std::int64_t line = 0;   ///< of the program, from 1
};

/// A program as text, and what its text means.
struct MadeProgram {
  std::string text;
  std::vector<Piece> pieces;
  std::vector<std::size_t> cuts;  ///< bytes used before each stretch that was asked for
};

/// Writes a program block by block, and keeps what each block means.
///
/// Numbers are rounded as they are written, and the block that is kept begins and ends at the
/// numbers in the text.
class ProgramBuilder {
 public:
  /// @param rapid_feedrate  of G00 [mm/s]
  explicit ProgramBuilder(double rapid_feedrate) : rapid_feedrate_(rapid_feedrate) {}

  enum class Plane : std::uint8_t { kXy, kZx, kYz };

  const Vec3& position() const noexcept { return position_; }
  Plane plane() const noexcept { return plane_; }
  bool is_exact() const noexcept { return is_exact_; }
  double feedrate() const noexcept { return feedrate_; }
  std::size_t size() const noexcept { return program_.pieces.size(); }
  const std::vector<Piece>& pieces() const noexcept { return program_.pieces; }

  void set_feedrate(double feedrate);         ///< F [mm/s]
  void set_plane(Plane plane);                ///< G17 G18 G19
  void set_inches(bool is_inch);              ///< G20 G21
  void set_incremental(bool is_incremental);  ///< G91 G90
  void set_continuous(double tolerance);      ///< G64, with P where the tolerance is above 0 [mm]
  void set_exact_stop();                      ///< G61
  /// Another stretch begins, after so many bytes.
  void begin_stretch(std::size_t bytes_used) { program_.cuts.push_back(bytes_used); }
  /// A line that means no motion: comments, numbers, words that are passed over.
  void add_chaff(std::size_t which);

  void rest(double duration);                    ///< G04 P, or M00 for 0 [s]
  void line_to(const Vec3& end, bool is_rapid);  ///< G01, G00
  /// G02, G03 about a centre relative to the position; whole turns end at their start.
  /// @param sweep  in the plane, counter-clockwise positive; 2 pi and more: a whole turn [rad]
  /// @param rise   along the plane's third axis [mm]
  /// @param by_radius  writes R in place of the centre, where that is well conditioned
  void arc(const Vec2& centre, double sweep, double rise, bool by_radius);
  /// G05.2: knots are uniform. @param points  without the first one, which is the position
  void uniform_nurbs(std::size_t degree, std::vector<Vec3> points, std::vector<double> weights);
  /// G06.2. @param inner  knots between 0 and 1, ascending: as many as points less degree
  void knot_nurbs(std::size_t degree, std::vector<Vec3> points, std::vector<double> weights,
                  const std::vector<double>& inner);

  MadeProgram take();

 private:
  void write(const std::string& text);
  double number(double mm) const;
  std::string word(char letter, double mm);
  std::string axis_word(int axis, double to, Vec3& end);
  std::string words_to(Vec3& end);
  void add(Shape shape, bool is_rapid);
  void end_nurbs(NurbsOutline nurbs, std::int64_t line);

  MadeProgram program_;
  double rapid_feedrate_;
  Vec3 position_ = Vec3::Zero();
  double feedrate_ = 0.0;
  double tolerance_ = 0.0;
  Plane plane_ = Plane::kXy;
  bool is_inch_ = false;
  bool is_incremental_ = false;
  bool is_exact_ = false;
  std::int64_t lines_ = 0;
};

}  // namespace twin::fuzz
