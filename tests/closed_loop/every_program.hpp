#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/path_settings.hpp"

namespace twin::test {

/// A program of nc_programs and the planner it is run with.
struct ProgramCase {
  const char* program;
  Planner planner;

  std::string name() const {
    const std::string file = program;
    return file.substr(0, file.find('.')) + (planner == Planner::kPaper ? "_paper" : "_certified");
  }
};

inline void PrintTo(const ProgramCase& tested, std::ostream* out) { *out << tested.name(); }

/// Every program that is kept in nc_programs, with both planners.
inline std::vector<ProgramCase> every_program() {
  std::vector<ProgramCase> cases;
  for (const char* const program :
       {"butterfly.nc", "butterfly_nurbs.nc", "circle.nc", "dolphin.nc", "gear.nc", "identify.nc",
        "mixed.nc", "oxalis.nc", "square.nc", "star.nc", "zigzag.nc"}) {
    cases.push_back({program, Planner::kCertified});
    cases.push_back({program, Planner::kPaper});
  }
  return cases;
}

}  // namespace twin::test
