#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/limits.hpp"
#include "core/text_table.hpp"
#include "gcode/program_text.hpp"
#include "pictures/figure/workshop.hpp"
#include "results/metrics/limit_audit.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// The planners, as the machine file calls them.
inline constexpr std::array<const char*, 2> kPlanners{"paper", "certified"};

/// One program under one planner; nothing moves.
struct PlannerRow {
  std::string program;       ///< file name
  std::string planner;       ///< "paper", "certified"
  results::Summary summary;  ///< with planning time and bound
  std::string verdict;       ///< of the audit
};

/// Plans each program with each planner.
///
/// @param request  its program and curve programs are not looked at
Expected<std::vector<PlannerRow>> planner_rows(const Request& request,
                                               const std::vector<gcode::ProgramText>& programs);

/// A line each program and planner.
TextTable grid_of_planners(const std::vector<PlannerRow>& rows);

/// Writes planners.md, planners.csv and planners.json; all of them or none.
Expected<void> write_planner_table(const std::vector<PlannerRow>& rows,
                                   const pictures::Workshop& workshop);

/// Whether the peaks of a trajectory keep the limits: "kept", or the worst one with its share, as
/// in "jerk 1.83".
///
/// Along the path the audit knows acceleration and jerk only up to 5 % (see LimitAudit); an excess
/// below that counts as kept. For the feedrate and for the axes it is 0.1 %.
std::string audit_verdict(const results::AuditPeaks& peaks, const Limits& limits);

}  // namespace twin::studies::compare
