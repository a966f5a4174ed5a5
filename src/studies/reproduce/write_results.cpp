#include "studies/reproduce/write_results.hpp"

#include <array>
#include <iterator>

#include "core/atomic_file.hpp"
#include "studies/reproduce/files.hpp"
#include "studies/reproduce/paper_figures.hpp"

namespace twin::studies::reproduce {
Expected<void> write_results(const Reproduction& reproduction, const pictures::Workshop& workshop,
                             bool draws) {
  std::vector<pictures::Picture> pictures;
  std::vector<std::string> names{"tables.csv", "reproduce.json", "tables.md", "index.html"};
  if (draws) {
    auto drawn = draw_figures(reproduction, workshop.folder() / "figures");
    if (!drawn) {
      return tl::unexpected(std::move(drawn.error()));
    }
    pictures = std::move(*drawn);
    names.insert(names.begin(), "figures");
  }
  const std::string texts[] = {csv_text(reproduction), json_text(reproduction),
                               markdown_text(reproduction), page_text(reproduction, pictures)};
  for (std::size_t i = 0; i < std::size(texts); ++i) {
    const std::string& name = names[names.size() - std::size(texts) + i];
    if (auto written = write_whole_file(workshop.folder() / name, texts[i]); !written) {
      return written;
    }
  }
  if (!draws) {
    workshop.discard_older(std::array<std::string, 1>{"figures"});
  }
  return workshop.deliver(names);
}

}  // namespace twin::studies::reproduce
