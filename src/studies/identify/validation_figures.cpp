#include "studies/identify/validation_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "pictures/figure/album.hpp"
#include "pictures/figure/figure_script.hpp"
#include "pictures/figure/value_range.hpp"

namespace twin::studies::identify {
namespace {

constexpr std::size_t kMostCurveRows = 8000;
constexpr std::array<std::string_view, 4> kCurves{"t_s", "less_twin_um", "less_filter_um",
                                                  "less_delay_um"};
constexpr std::array<const char*, 3> kCaptions{"(a) measured less simulated in closed loop",
                                               "(b) measured less filter of 10 taps",
                                               "(c) measured less delayed set point"};

}  // namespace

Expected<void> draw_validations(const std::vector<Validation>& validations,
                                const std::filesystem::path& folder) {
  if (validations.empty()) {
    return {};
  }
  TWIN_TRY(pictures::Album album, pictures::Album::open(folder));
  for (std::size_t i = 0; i < validations.size(); ++i) {
    const Validation& v = validations[i];
    const char* const axis = v.axis == hal::kX ? "x" : "y";
    const std::string name = fmt::format("validation_{}_{}", i + 1, axis);
    results::Decimator decimator(kCurves.size(), {1, 2, 3}, kMostCurveRows);
    for (const auto& row : v.curves) {
      decimator.push(row);
    }
    const results::Table table = decimator.finish();
    TWIN_CHECK(album.write_data(name, kCurves, table));
    std::vector<pictures::Panel> panels;
    for (std::size_t k = 0; k < kCaptions.size(); ++k) {
      panels.push_back({kCaptions[k], "time [s]", "error [µm]",
                        pictures::y_axis(pictures::range_of(table, k + 1)),
                        fmt::format("'{}.csv' using 't_s':'{}' with lines linestyle {}", name,
                                    kCurves[k + 1], k + 1),
                        230});
    }
    album.add(name,
              fmt::format("{} of {}{}", axis, std::filesystem::path(v.trace).filename().string(),
                          v.is_held_out ? ", held out" : ", validation"),
              panels);
  }
  TWIN_CHECK(album.draw());
  return {};
}

}  // namespace twin::studies::identify
