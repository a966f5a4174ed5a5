#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "gcode/program_text.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/planning.hpp"
#include "runtime/set_points.hpp"
#include "shadow/report.hpp"
#include "twin/twin.hpp"

/// What is behind the public types, for the sources of this folder.
namespace twin {

struct Program::Data {
  gcode::ProgramText source;
  std::optional<double> feedrate;  // in place of the F words [mm/s]
};

struct Settings::Data {
  config::MachineFile machine;
};

struct Interpolator::Data {
  std::unique_ptr<runtime::SetPoints> points;
  double period = 0.001;  // [s]
};

struct Summary::Data {
  std::string json;
  std::string table;
  std::vector<std::string> keys;  // in the order of the JSON
  std::map<std::string, double, std::less<>> numbers;
  std::map<std::string, std::string, std::less<>> texts;
};

struct Panel::Data {
  runtime::OperatorPanel panel;
  std::atomic<bool> stop{false};
};

/// The public types' friend.
struct Inside {
  static const Program::Data& of(const Program& program) { return *program.data_; }
  static const config::MachineFile& of(const Settings& settings) { return settings.data_->machine; }
  static Panel::Data& of(Panel& panel) { return *panel.data_; }

  static Plan plan(const Program& program, const Settings& settings,
                   const runtime::PlanFigures& figures);
  static Settings settings(config::MachineFile machine);
  static ShadowReport report(const shadow::ShadowReport& seen, const std::string& trace);
  static Summary summary(const results::Summary& summary, const Limits& limits);
};

/// The value, or its error as an exception.
template <class T>
T value_of(Expected<T> result) {
  if (!result) {
    throw Failure(std::move(result.error()));
  }
  return *std::move(result);
}

/// Makes a folder if it is missing.
Expected<void> make_folder(const std::filesystem::path& folder);

inline void check(Expected<void> result) {
  if (!result) {
    throw Failure(std::move(result.error()));
  }
}

}  // namespace twin
