#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// One figure by which contestants are compared.
struct FigureKind {
  std::string_view key;   ///< "contour_error_max_um"
  std::string_view name;  ///< "contour error max"
  std::string_view unit;
  int decimals = 0;
  double (*get)(const Contestant& contestant);      ///< in that unit
  double (*limit)(const Limits& limits) = nullptr;  ///< what it should not exceed, if anything
};

std::span<const FigureKind> figure_kinds();

}  // namespace twin::studies::compare
