#pragma once

namespace twin {

/// How a run on the wall clock keeps time; section [realtime] of the machine file.
struct RealtimeSettings {
  int priority = 80;          ///< SCHED_FIFO priority of the motion thread; 0: ordinary scheduling
  int cpu = -1;               ///< CPU that the motion thread stays on; -1: any
  bool lock_memory = true;    ///< keep the process's memory from being swapped out
  int max_late_periods = 10;  ///< so many late periods in a row end the motion
  double max_stall = 0.1;     ///< one period as late as this ends it too [s]
};

}  // namespace twin
