#include "pictures/plot/figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/units.hpp"
#include "pictures/plot/figure_data.hpp"
#include "pictures/plot/gnuplot.hpp"
#include "pictures/plot/scripts.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/trace_files.hpp"

namespace twin::pictures {

namespace fs = std::filesystem;

namespace {

/// The timing figure of an earlier run, which kept to the wall clock.
void remove_timing(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"timing.gp", "timing.png", "timing.svg"}) {
    fs::remove(folder / name, ignored);
  }
}

/// What summary.json says of the trace beside it, as far as figures show it.
struct RunOrigin {
  bool is_simulated = false;  ///< a machine moved, but no metal; false when nothing is known
  double period = 0.0;        ///< [s]; 0 when nothing is known
  double acceleration = 0.0;  ///< its limit [mm/s^2]; 0 when nothing is known
  double jerk = 0.0;          ///< its limit [mm/s^3]; 0 when nothing is known
  std::string settings;       ///< in one line; empty when nothing is known
};

/// A number of a summary; NaN where it has none there.
double number_at(const Json& summary, const char* place) {
  const auto value = summary.value(Json::json_pointer(place), Json());
  return value.is_number() ? value.get<double>() : NAN;
}

/// "certified planner, at most 2450 mm/s² and 50·10³ mm/s³, within 10 µm, kp 298.6 and 111.2 /s".
std::string settings_line(const Json& summary, const RunOrigin& origin) {
  const double chord = number_at(summary, "/settings/planning/chord_error_mm");
  const std::string* const planner = text_in(summary, "planner");
  if (planner == nullptr || origin.acceleration <= 0.0 || origin.jerk <= 0.0 || std::isnan(chord)) {
    return {};
  }
  std::string line =
      fmt::format("{} planner, at most {:g} mm/s² and {:g}·10³ mm/s³, within {:g} µm", *planner,
                  origin.acceleration, origin.jerk / 1000.0, units::um_from_mm(chord));
  // A plan has no servo.
  const double kp_x = number_at(summary, "/settings/servo.x/kp_per_s");
  const double kp_y = number_at(summary, "/settings/servo.y/kp_per_s");
  if (summary.contains("machining_time_s") && !std::isnan(kp_x + kp_y)) {
    line += fmt::format(", kp {:.4g} and {:.4g} /s", kp_x, kp_y);
  }
  return line;
}

/// Reads it from a summary; a file that is missing or is none says nothing.
RunOrigin read_run_origin(const fs::path& summary) {
  const auto text = read_whole_file(summary);
  const Json json = parse_json(text ? *text : std::string());
  RunOrigin origin;
  if (!json.is_object()) {
    return origin;
  }
  const auto simulated = json.find("simulated");
  origin.is_simulated = simulated != json.end() && simulated->is_boolean() &&
                        simulated->get<bool>() && json.contains("machining_time_s");
  origin.period = number_in(json, "period_s").value_or(0.0);
  const auto limit = [&json](const char* place) {
    const double value = number_at(json, place);
    return std::isnan(value) ? 0.0 : value;
  };
  origin.acceleration = limit("/settings/limits/acceleration_mm_per_s2");
  origin.jerk = limit("/settings/limits/jerk_mm_per_s3");
  origin.settings = settings_line(json, origin);
  return origin;
}

/// "dolphin.nc, simulated": a title that says so where it is.
std::string title_of(const std::string& title, const RunOrigin& origin) {
  if (!origin.is_simulated) {
    return title;
  }
  return title.empty() ? "simulated" : title + ", simulated";
}

}  // namespace

Expected<std::vector<fs::path>> write_figures(const FigureInput& input) {
  const fs::path folder = input.directory / "plots";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return file_error(folder, "create", error.value());
  }
  TWIN_TRY(DataSummary data,
           write_figure_data(input.directory / input.trace, folder, input.programmed,
                             results::ProgramZero::beside(input.directory / input.trace),
                             input.plan_only));
  const RunOrigin origin = read_run_origin(input.directory / (results::is_partial_trace(input.trace)
                                                                  ? "summary.partial.json"
                                                                  : "summary.json"));
  data.acceleration_limit = origin.acceleration;
  data.jerk_limit = origin.jerk;
  const Heading heading{title_of(input.title, origin), origin.settings};
  std::vector<Script> scripts = figure_scripts(heading, data, input.plan_only);
  if (fs::exists(folder / results::kTimingName)) {
    scripts.push_back(timing_script(heading, origin.period));
  } else {
    remove_timing(folder);
  }
  return draw(folder, scripts, input.paper);
}

}  // namespace twin::pictures
