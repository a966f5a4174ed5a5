#pragma once

#include <fmt/format.h>

#include <utility>

#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::test {

/// A reproduction whose figures are the published ones times a factor.
inline studies::reproduce::Reproduction scaled(double single, double mean) {
  studies::reproduce::Reproduction result;
  result.source = "the \"paper\" & its tables";
  result.machine = "table";
  result.repeats = 3;
  result.variants[0].name = "as_published";
  result.variants[1].name = "defaults";
  const auto paper = studies::reproduce::published();
  for (studies::reproduce::Variant& variant : result.variants) {
    variant.title = variant.name;
    for (const studies::reproduce::PublishedRow& row : paper->rows) {
      studies::reproduce::Answer answer;
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

}  // namespace twin::test
