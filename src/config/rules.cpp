#include "config/rules.hpp"

#include <fmt/format.h>

#include "config/rig_rules.hpp"

namespace twin::config {

Expected<void> check_rules(const MachineFile& machine) {
  const Limits& l = machine.limits;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!(l.travel_min[i] < l.travel_max[i])) {
      return fail(ErrorCode::kFile,
                  fmt::format("limits.travel_min_mm is {:g} and travel_max_mm is {:g} mm in {}: "
                              "the lower end must be below the upper",
                              l.travel_min[i], l.travel_max[i], "xyz"[i]));
    }
  }
  if (machine.path.min_segments > machine.path.max_segments) {
    return fail(ErrorCode::kFile,
                fmt::format("planning.min_segments = {} is more than planning.max_segments = {}",
                            machine.path.min_segments, machine.path.max_segments));
  }
  return check_rig_rules(machine.rig);
}

}  // namespace twin::config
