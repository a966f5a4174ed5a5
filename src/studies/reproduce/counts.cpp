#include "studies/reproduce/counts.hpp"

#include <cmath>

#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {

bool is_within(double ours, double published, double share) {
  constexpr double kRounding = 1e-12;
  return std::abs(ours / published - 1.0) <= share + kRounding;
}

double ours(const Answer& answer, std::size_t i, Of of) {
  return of == Of::kMean && !answer.repeats.empty() ? answer.repeats[i].mean : answer.single[i];
}

Counts count(const Variant& variant, Of of) {
  Counts counts;
  for (const Answer& answer : variant.answers) {
    const PublishedRow& row = answer.published;
    if (!is_measured(row.table)) {
      continue;
    }
    const auto columns = columns_of(row.table);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      ++counts.total;
      const double value = ours(answer, i, of);
      for (std::size_t j = 0; j < kShares.size(); ++j) {
        counts.within[j] += is_within(value, row.values[i], kShares[j]) ? 1 : 0;
      }
      const double off = value / row.values[i] - 1.0;
      if (columns[i].key == "time_s" && std::abs(off) > std::abs(counts.worst_time)) {
        counts.worst_time = off;
      }
    }
  }
  return counts;
}

std::string missed(const Answer& answer, Of of) {
  std::string names;
  const auto columns = columns_of(answer.published.table);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!is_within(ours(answer, i, of), answer.published.values[i], kShares.back())) {
      names += (names.empty() ? "" : ", ") + std::string(columns[i].name);
    }
  }
  return names;
}

}  // namespace twin::studies::reproduce
