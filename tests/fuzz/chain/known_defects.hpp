#pragma once

#include <string_view>

#include "tests/fuzz/chain/limit_check.hpp"

/// Defects of the planner that are known and not mended yet, each as a filter, so that the fuzzer
/// finds something else. A filter goes with its defect; without any this file goes too. The
/// environment variable TWIN_FUZZ_KNOWN switches all filters off.
namespace twin::fuzz {

/// The known defect by which a measure of a case exceeds what is tolerated; empty if there is none.
std::string_view known_defect(const Case& made, Measure measure, double share);

}  // namespace twin::fuzz
