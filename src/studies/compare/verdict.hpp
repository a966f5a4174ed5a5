#pragma once

#include <string>

#include "core/limits.hpp"
#include "results/metrics/limit_audit.hpp"

namespace twin::studies::compare {

/// Whether the peaks of a trajectory keep the limits: "kept", or the worst one with its share, as
/// in "jerk 1.83".
///
/// Along the path the audit knows acceleration and jerk only up to 5 % (see LimitAudit); an excess
/// below that counts as kept. For the feedrate and for the axes it is 0.1 %.
std::string audit_verdict(const results::AuditPeaks& peaks, const Limits& limits);

}  // namespace twin::studies::compare
