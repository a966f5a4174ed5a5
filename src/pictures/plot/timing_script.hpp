#pragma once

#include <string>

#include "pictures/plot/scripts.hpp"

namespace twin::pictures {

/// The figure of a run on the wall clock, from timing.csv: how many periods over how late they
/// began, how long their computation took, and when their outputs were written.
///
/// @param period  marked by a line [s]; 0: none
Script timing_script(const std::string& title, double period);

}  // namespace twin::pictures
