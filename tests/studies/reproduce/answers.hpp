#pragma once

#include <fmt/format.h>

#include <utility>

#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce::test {

/// A reproduction whose figures are the published ones times a factor.
inline Reproduction scaled(double single, double mean) {
  Reproduction result;
  result.source = "the \"paper\" & its tables";
  result.machine = "table";
  result.repeats = 3;
  result.variants[0].name = "as_published";
  result.variants[1].name = "defaults";
  const auto paper = published();
  for (Variant& variant : result.variants) {
    variant.title = variant.name;
    for (const PublishedRow& row : paper->rows) {
      Answer answer;
      answer.published = row;
      for (const double figure : row.values) {
        answer.single.push_back(single * figure);
        answer.repeats.push_back({mean * figure, 0.1 * figure});
      }
      variant.answers.push_back(std::move(answer));
    }
  }
  return result;
}

}  // namespace twin::studies::reproduce::test
