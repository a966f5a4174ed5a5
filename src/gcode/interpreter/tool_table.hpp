#pragma once

#include <filesystem>
#include <map>
#include <string_view>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace twin::gcode {

/// A tool as the tool table has it.
struct Tool {
  Vec3 offset = Vec3::Zero();  ///< from the end of the spindle to the tip, Z its length [mm]
  double diameter = 0.0;       ///< [mm]
};

/// The tools of a machine, by their number.
///
/// A file of it has one tool a line, in the format of LinuxCNC:
///     T1 P1 X0 Y0 Z50.2 D6 ; 6 mm end mill
/// T is the number of the tool, P its pocket, X Y Z its offset and D its diameter, in mm. A B C U V
/// W I J Q may follow and are not used, nor is P. A semicolon begins a remark. Source: LinuxCNC,
/// "Tool Table Format".
class ToolTable {
 public:
  static constexpr std::size_t kMostTools = 100000;
  static constexpr double kLargestNumber = 1e5;  ///< of an offset or a diameter [mm]

  /// Reads a file. @returns an error with file, line and column
  static Expected<ToolTable> read(const std::filesystem::path& file);
  /// Reads a text. @param name  takes the place of the file in messages
  static Expected<ToolTable> from_text(std::string_view text, const std::string& name);

  /// The tool of a number, or null.
  const Tool* find(int number) const;
  void set(int number, const Tool& tool) { tools_[number] = tool; }
  bool is_empty() const noexcept { return tools_.empty(); }

 private:
  std::map<int, Tool> tools_;
};

}  // namespace twin::gcode
