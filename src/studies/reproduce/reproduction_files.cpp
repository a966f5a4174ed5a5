#include "studies/reproduce/reproduction_files.hpp"

#include <fmt/format.h>

#include "core/json.hpp"
#include "studies/reproduce/counts.hpp"
#include "studies/reproduce/paper_figures.hpp"
#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {
namespace {

/// Calls visit(variant, answer, i) for each number of each row.
template <class Visit>
void for_each_number(const Reproduction& reproduction, Visit visit) {
  for (std::size_t row = 0; row < reproduction.as_published().answers.size(); ++row) {
    for (const Variant& variant : reproduction.variants) {
      const Answer& answer = variant.answers[row];
      for (std::size_t i = 0; i < answer.single.size(); ++i) {
        visit(variant, answer, i);
      }
    }
  }
}

Json counts_json(const Counts& counts) {
  Json json;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    json[fmt::format("within_{:.0f}_percent", 100.0 * kShares[i])] = counts.within[i];
  }
  json["of"] = counts.total;
  json["largest_time_deviation_percent"] = rounded(100.0 * counts.worst_time);
  return json;
}

Json number_json(const Variant& variant, const Answer& answer, std::size_t i) {
  const PublishedRow& row = answer.published;
  const PublishedColumn& column = columns_of(row.table)[i];
  Json json{{"table", row.table},
            {"program", row.program},
            {"interpolator", row.interpolator},
            {"feedrate_mm_per_min", row.feedrate_mm_per_min},
            {"variant", variant.name},
            {"figure", column.key},
            {"unit", column.unit},
            {"published", row.values[i]},
            {"ours", rounded(answer.single[i])}};
  if (!answer.repeats.empty()) {
    json["mean"] = rounded(answer.repeats[i].mean);
    json["sd"] = rounded(answer.repeats[i].deviation);
  }
  return json;
}

}  // namespace

std::string csv_text(const Reproduction& reproduction) {
  std::string text =
      "table,program,interpolator,feedrate_mm_per_min,variant,figure,unit,published,ours,ratio,"
      "mean,sd,mean_ratio\n";
  for_each_number(reproduction, [&](const Variant& variant, const Answer& answer, std::size_t i) {
    const PublishedRow& row = answer.published;
    const PublishedColumn& column = columns_of(row.table)[i];
    const double published = row.values[i];
    text += fmt::format("{},{},{},{:g},{},{},{},{:g},{:.6g},{:.4f}", row.table, row.program,
                        row.interpolator, row.feedrate_mm_per_min, variant.name, column.key,
                        column.unit, published, answer.single[i], answer.single[i] / published);
    text += answer.repeats.empty()
                ? ",,,\n"
                : fmt::format(",{:.6g},{:.4g},{:.4f}\n", answer.repeats[i].mean,
                              answer.repeats[i].deviation, answer.repeats[i].mean / published);
  });
  return text;
}

std::string json_text(const Reproduction& reproduction) {
  Json json{{"source", reproduction.source},
            {"machine", reproduction.machine},
            {"repeats", reproduction.repeats}};
  for (const Variant& variant : reproduction.variants) {
    json["counts"][variant.name]["single"] = counts_json(count(variant, Of::kSingle));
    if (reproduction.repeats > 0) {
      json["counts"][variant.name]["mean"] = counts_json(count(variant, Of::kMean));
    }
  }
  json["figures"] = Json::array();
  for_each_number(reproduction, [&](const Variant& variant, const Answer& answer, std::size_t i) {
    json["figures"].push_back(number_json(variant, answer, i));
  });
  return to_text(json);
}

std::string markdown_text(const Reproduction& reproduction) {
  std::string text = fmt::format(
      "# Published figures beside ours\n\n{}; our machine: {}. A ratio is ours / published, bold "
      "where it is more than 30 % off.\n\n",
      reproduction.source, reproduction.machine);
  text += to_markdown(grid_of_counts(reproduction));
  for (int table = kFirstTable; table <= kLastTable; ++table) {
    text += to_markdown(grid_of_table(reproduction, table));
  }
  text += "## What differs, and why\n\n";
  for (const std::string& difference : differences(reproduction)) {
    text += "- " + difference + "\n";
  }
  return text;
}

Expected<void> write_results(const Reproduction& reproduction, const pictures::Workshop& workshop,
                             pictures::Drawing drawing) {
  std::vector<pictures::Picture> pictures;
  if (drawing == pictures::Drawing::kDrawn) {
    TWIN_TRY(pictures, draw_figures(reproduction, workshop.pictures()));
  }
  const pictures::NamedText texts[] = {{"tables.csv", csv_text(reproduction)},
                                       {"reproduce.json", json_text(reproduction)},
                                       {"tables.md", markdown_text(reproduction)},
                                       {"index.html", page_text(reproduction, pictures)}};
  return workshop.deliver_study(texts, drawing);
}

}  // namespace twin::studies::reproduce
