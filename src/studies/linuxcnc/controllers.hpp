#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/text_table.hpp"
#include "gcode/program_text.hpp"
#include "results/metrics/summary.hpp"

namespace twin::studies::linuxcnc {

/// Who moves the table.
enum class Controller {
  kTwin,      ///< this program
  kUnmerged,  ///< LinuxCNC, G64 P of the chord tolerance, Q0
  kMerged,    ///< LinuxCNC, G64 P and Q of it: short blocks become one
};
inline constexpr std::size_t kControllers = 3;

/// One program on the same table under each controller.
struct ProgramRow {
  std::string program;
  std::array<std::optional<results::Summary>, kControllers> summary;
  std::array<std::string, kControllers> why_not;           ///< where there is no summary
  std::array<std::filesystem::path, kControllers> folder;  ///< of the results
};

/// What is compared.
struct ContestRequest {
  config::MachineFile machine;
  std::vector<gcode::ProgramText> programs;
  std::filesystem::path folder;  ///< of the results
  std::string command{};
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress{};
};

/// The text of a program for LinuxCNC, whose bare G64 means no tolerance: G64 gets P and Q [mm], and
/// so does the beginning.
std::string with_tolerance(std::string_view text, double tolerance, double merging);

/// Runs each program under this controller and, headless, under LinuxCNC with its own pid at the
/// gains of the machine file, on the same simulated table.
Expected<std::vector<ProgramRow>> compare_controllers(const ContestRequest& request);

/// Machining time, contour errors at command, encoder and table, peaks of acceleration and jerk, and
/// whether the set points keep the chord tolerance.
TextTable table_of(const std::vector<ProgramRow>& rows, double tolerance);

/// Writes controllers.html, a page with the table, and a page a program that shows all runs of it.
Expected<std::filesystem::path> write_pages(const ContestRequest& request,
                                            const std::vector<ProgramRow>& rows);

}  // namespace twin::studies::linuxcnc
