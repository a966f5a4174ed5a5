#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace twin::results {

/// Height of the program's Z0 on the machine over the time of a run. It is 0 unless a tool's length,
/// a work offset or the place of the workpiece lifts it. The pen draws where it is not above it by
/// more than kPenUp.
class ProgramZero {
 public:
  static constexpr std::size_t kMostChanges = 1000;  ///< further ones are not kept

  /// A height from an instant on.
  struct Change {
    double t;       ///< [s]
    double height;  ///< [mm]
  };

  /// Takes the height of an instant, which must not lie before the last one.
  void add(double t, double height);

  /// The height at an instant [mm].
  double at(double t) const noexcept;

  const std::vector<Change>& changes() const noexcept { return changes_; }

  /// That of the summary beside a trace; 0 for ever where that says nothing.
  static ProgramZero beside(const std::filesystem::path& trace);
  /// That of a summary's text.
  static ProgramZero of_summary(std::string_view text);

 private:
  std::vector<Change> changes_;
};

}  // namespace twin::results
