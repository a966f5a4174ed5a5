#include "studies/reproduce/reproduction_files.hpp"

#include <fmt/format.h>

#include <utility>

#include "studies/reproduce/counts.hpp"
#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {
namespace {

std::string title_of(const Reproduction& reproduction, int table) {
  switch (table) {
    case 1:
      return "Table 1: blocks of the NC programs";
    case 2:
      return "Table 2: parameters";
    case 3:
      return "Table 3: curves and contour error of the command, 3,000 mm/min";
    default:
      for (const Answer& answer : reproduction.as_published().answers) {
        if (answer.published.table == table) {
          return fmt::format("Table {}: {}, measured", table, answer.published.program);
        }
      }
      return fmt::format("Table {}", table);
  }
}

std::string row_name(const PublishedRow& row) {
  return is_measured(row.table) ? row.short_name() : row.table == 2 ? "" : row.program;
}

/// One line of numbers; `text` makes a cell of each.
template <class Text>
Line line(std::string what, const Answer& answer, Text text) {
  Line line{.row = {}, .what = std::move(what), .cells = {}, .note = {}};
  const auto columns = columns_of(answer.published.table);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    line.cells.push_back(text(i, columns[i].decimals));
  }
  return line;
}

Line ratios(const std::string& what, const Answer& answer, Of of) {
  Line result = line(what, answer, [&](std::size_t i, int) {
    const double value = ours(answer, i, of);
    const double published = answer.published.values[i];
    return Cell{fmt::format("{:.2f}", value / published), mark_of(value, published)};
  });
  result.note = missed(answer, of);
  return result;
}

/// Our lines of one variant.
void add_ours(TextTable& grid, const Answer& answer, const std::string& title, int repeats) {
  grid.lines.push_back(line(title, answer, [&](std::size_t i, int decimals) {
    return Cell{fmt::format("{:.{}f}", answer.single[i], decimals)};
  }));
  grid.lines.push_back(ratios("  ratio", answer, Of::kSingle));
  if (!is_measured(answer.published.table) || answer.repeats.empty()) {
    return;  // what is planned does not depend on the phases of the table
  }
  grid.lines.push_back(
      line(fmt::format("  mean of {}", repeats), answer, [&](std::size_t i, int decimals) {
        return Cell{fmt::format("{:.{}f}", answer.repeats[i].mean, decimals)};
      }));
  grid.lines.push_back(line("  their sd", answer, [&](std::size_t i, int decimals) {
    return Cell{fmt::format("{:.{}f}", answer.repeats[i].deviation, decimals)};
  }));
  grid.lines.push_back(ratios("  ratio of mean", answer, Of::kMean));
}

Line counts_line(const std::string& row, const std::string& what, const Counts& counts) {
  Line line{.row = row, .what = what, .cells = {}, .note = {}};
  for (const int within : counts.within) {
    line.cells.push_back({fmt::format("{}", within)});
  }
  line.cells.push_back({fmt::format("{}", counts.total)});
  line.cells.push_back({fmt::format("{:+.1f} %", 100.0 * counts.worst_time)});
  return line;
}

}  // namespace

Mark mark_of(double ours, double published) {
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    if (is_within(ours, published, kShares[i])) {
      return static_cast<Mark>(i + 1);
    }
  }
  return Mark::kOutside;
}

TextTable grid_of_table(const Reproduction& reproduction, int table) {
  TextTable grid;
  grid.title = title_of(reproduction, table);
  grid.note_head = "more than 30 % off";
  for (const PublishedColumn& column : columns_of(table)) {
    grid.head.push_back(column.unit.empty() ? std::string(column.name)
                                            : fmt::format("{} {}", column.name, column.unit));
  }
  const auto& answers = reproduction.as_published().answers;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& answer = answers[i];
    if (answer.published.table != table) {
      continue;
    }
    grid.lines.push_back(line("published", answer, [&](std::size_t k, int decimals) {
      return Cell{fmt::format("{:.{}f}", answer.published.values[k], decimals)};
    }));
    grid.lines.back().row = row_name(answer.published);
    const Answer& by_default = reproduction.defaults().answers[i];
    if (table <= 2) {  // neither depends on the variant
      add_ours(grid, by_default, "ours", reproduction.repeats);
    } else if (answer.published.settings.empty()) {
      add_ours(grid, by_default, "both ways", reproduction.repeats);
    } else {
      add_ours(grid, answer, "as published", reproduction.repeats);
      add_ours(grid, by_default, "defaults", reproduction.repeats);
    }
  }
  return grid;
}

TextTable grid_of_counts(const Reproduction& reproduction) {
  TextTable grid;
  grid.title = "Numbers of Tables 4 and 5 within 10, 20 and 30 % of the published ones";
  grid.head = {"10 %", "20 %", "30 %", "of", "time, largest deviation"};
  for (const Variant& variant : reproduction.variants) {
    grid.lines.push_back(counts_line(variant.title, "one run", count(variant, Of::kSingle)));
    if (reproduction.repeats > 0) {
      grid.lines.push_back(counts_line("", fmt::format("mean of {}", reproduction.repeats),
                                       count(variant, Of::kMean)));
    }
  }
  return grid;
}

}  // namespace twin::studies::reproduce
