#include "plot/figures.hpp"

#include "core/atomic_file.hpp"
#include "plot/draw.hpp"
#include "plot/figure_data.hpp"
#include "plot/scripts.hpp"
#include "trace/columns.hpp"

namespace twin::plot {

namespace fs = std::filesystem;

Expected<std::vector<fs::path>> write_figures(const FigureInput& input) {
  const fs::path folder = input.directory / "plots";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return file_error(folder, "create", error.value());
  }
  const auto data = write_figure_data(input.directory / trace::kTraceName, folder, input.programmed,
                                      input.plan_only);
  if (!data) {
    return tl::unexpected(data.error());
  }
  return draw(folder, figure_scripts(input.title, *data, input.plan_only));
}

}  // namespace twin::plot
