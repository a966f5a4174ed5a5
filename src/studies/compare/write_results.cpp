#include "studies/compare/write_results.hpp"

#include <array>
#include <utility>

#include "studies/compare/compare_figures.hpp"
#include "studies/compare/texts.hpp"

namespace twin::studies::compare {

Expected<void> write_results(const Comparison& comparison, const pictures::Workshop& workshop,
                             bool draws) {
  std::vector<std::string> names;
  if (draws) {
    if (auto drawn = draw_figures(comparison, workshop.folder() / "figures"); !drawn) {
      return tl::unexpected(std::move(drawn.error()));
    }
    names.emplace_back("figures");
  } else {
    workshop.discard_older(std::array<std::string, 1>{"figures"});
  }
  const std::pair<const char*, std::string> texts[] = {
      {"compare.csv", interpolators_csv(comparison)},
      {"fluctuation.csv", fluctuations_csv(comparison)},
      {"compare.json", json_text(comparison)},
      {"compare.md", markdown_text(comparison)}};
  if (auto written = workshop.write(texts, names); !written) {
    return written;
  }
  return workshop.deliver(names);
}

}  // namespace twin::studies::compare
