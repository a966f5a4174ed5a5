#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/error.hpp"
#include "gcode/interpreter/coordinates.hpp"
#include "gcode/interpreter/tool_table.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

class LineWords;
class Notes;
struct ModalState;

/// What a program sets up before it moves: coordinates, tools and the places of G28 and G30.
class SetUp {
 public:
  explicit SetUp(const ReaderOptions& options);

  const Coordinates& coordinates() const noexcept { return coordinates_; }
  int tool() const noexcept { return tool_; }  ///< number of the one in the spindle; 0: none
  int selected_tool() const noexcept { return selected_tool_; }   ///< number of the last T
  const Vec3& home() const noexcept { return homes_[0]; }         ///< G28 [mm]
  const Vec3& second_home() const noexcept { return homes_[1]; }  ///< G30 [mm]

  /// True if a line has a word that may change the set-up.
  static bool concerns(const LineWords& words) noexcept;

  /// Executes M06 and M61, which come first on a line, and T.
  Expected<void> change_tool(const LineWords& words);

  /// Executes the words of a line that set something.
  ///
  /// @param place  where the tool is, in the coordinates of the program; brought up to date [mm]
  Expected<void> apply(const LineWords& words, const ModalState& state, Vec3& place, Notes& notes,
                       std::int64_t line);

  /// Puts a work offset and an offset of the tool in force. @param place  as for apply()
  void restore(std::size_t work_offset, const Vec3& tool_offset, Vec3& place);

  /// Axes, a bit for each, that the next absolute move must name: behind G68, G69, G51.1 and G50.1
  /// controls do not agree on the coordinate of an axis that is left out.
  std::uint32_t axes_to_name() const noexcept { return axes_to_name_; }
  void axes_named(std::uint32_t axes) noexcept { axes_to_name_ &= ~axes; }

  /// Radius for G41 and G42 of a line, above zero to the left [mm].
  Expected<double> cutter_radius(const LineWords& words, const ModalState& state, Notes& notes,
                                 std::int64_t line) const;

  /// A parameter of the control: 5161 to 5163, 5181 to 5183, 5210 to 5390, 5400 to 5410 [mm, deg].
  std::optional<double> parameter(int number) const;
  /// Sets one. @returns false if the number is none of them, or must not be set
  bool set_parameter(int number, double value);

 private:
  Expected<void> set_tool_offset(const LineWords& words, const ModalState& state, Notes& notes,
                                 std::int64_t line);
  Expected<void> select_work_offset(const LineWords& words);
  Expected<void> overlay(const LineWords& words, const ModalState& state, const Vec3& place);
  Expected<void> set(const LineWords& words, const ModalState& state, const Vec3& place);
  Expected<void> set_offsets(const LineWords& words, const ModalState& state, const Vec3& place);
  Expected<void> set_work_offset(const LineWords& words, const ModalState& state, const Vec3& place,
                                 bool from_place);
  Expected<void> set_tool(const LineWords& words, const ModalState& state, const Vec3& place);
  Expected<void> set_shift(const LineWords& words, const ModalState& state, const Vec3& place);
  const Tool* tool_or_note(int number, std::string_view what, Notes& notes,
                           std::int64_t line) const;

  Dialect dialect_;
  Coordinates coordinates_;
  ToolTable tools_;
  std::array<Vec3, 2> homes_{Vec3::Zero(), Vec3::Zero()};
  int selected_tool_ = 0;
  int tool_ = 0;
  std::uint32_t axes_to_name_ = 0;
};

}  // namespace twin::gcode
