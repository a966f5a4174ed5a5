#pragma once

#include <string>

#include "core/limits.hpp"
#include "results/metrics/limit_audit.hpp"

namespace twin::studies::compare {

/// Whether the peaks of a trajectory keep the limits: "kept", or the worst one with its share, as
/// in "jerk 1.83".
///
/// Along the path the audit carries a doubt of up to 5 % of acceleration and jerk (LimitAudit);
/// up to there they count as kept, and feedrate and what axes do up to 0.1 %.
std::string audit_verdict(const results::AuditPeaks& peaks, const Limits& limits);

}  // namespace twin::studies::compare
