#include "studies/compare/planner_table.hpp"

#include <gtest/gtest.h>

namespace twin::studies::compare {
namespace planner_table_test {

TEST(Verdict, WhatKeepsEveryLimitIsKept) {
  const Limits limits;
  results::AuditPeaks peaks;
  peaks.feedrate = limits.feedrate;
  peaks.tangential_acceleration = limits.acceleration;
  peaks.normal_acceleration = limits.acceleration;
  peaks.tangential_jerk = 1.03 * limits.jerk;  // within the audit's doubt
  peaks.axis[0].jerk = 1e9;                    // has no limit of its own
  EXPECT_EQ(audit_verdict(peaks, limits), "kept");
}

TEST(Verdict, TheWorstIsNamed) {
  Limits limits;
  limits.axis_acceleration = {0.0, 1000.0, 0.0};
  results::AuditPeaks peaks;
  peaks.tangential_jerk = 1.2 * limits.jerk;
  EXPECT_EQ(audit_verdict(peaks, limits), "jerk 1.20");
  peaks.axis[1].acceleration = 1500.0;
  EXPECT_EQ(audit_verdict(peaks, limits), "axis acceleration 1.50");
}

}  // namespace planner_table_test
}  // namespace twin::studies::compare
