#include "cli/rig_look.hpp"

#include <utility>

#include "hal/rig/assemble/look.hpp"

namespace twin::cli {

Expected<RigToLookAt> open_to_look(const Options& options) {
  namespace assemble = hal::rig::assemble;
  RigToLookAt seen;
  TWIN_TRY(seen.machine, read_machine(options));
  TWIN_TRY(seen.kind, find_rig(options, seen.machine));
  seen.settings = assemble::wiring_to_look_with(seen.kind, seen.machine.rig);
  TWIN_TRY(seen.ports,
           assemble::open_to_look(seen.kind, setup_of(options, seen.machine), seen.machine.period));
  return seen;
}

}  // namespace twin::cli
