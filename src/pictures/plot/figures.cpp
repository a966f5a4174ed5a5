#include "pictures/plot/figures.hpp"

#include "core/atomic_file.hpp"
#include "pictures/plot/draw.hpp"
#include "pictures/plot/figure_data.hpp"
#include "pictures/plot/run_origin.hpp"
#include "pictures/plot/scripts.hpp"
#include "pictures/plot/timing_script.hpp"
#include "results/trace/columns.hpp"

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

}  // namespace

Expected<std::vector<fs::path>> write_figures(const FigureInput& input) {
  const fs::path folder = input.directory / "plots";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return file_error(folder, "create", error.value());
  }
  TWIN_TRY(const DataSummary data, write_figure_data(input.directory / results::kTraceName, folder,
                                                     input.programmed, input.plan_only));
  const RunOrigin origin = read_run_origin(input.directory);
  const std::string title = title_of(input.title, origin);
  std::vector<Script> scripts = figure_scripts(title, data, input.plan_only);
  if (fs::exists(folder / results::kTimingName)) {
    scripts.push_back(timing_script(title, origin.period));
  } else {
    remove_timing(folder);
  }
  return draw(folder, scripts);
}

}  // namespace twin::pictures
