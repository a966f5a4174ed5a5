#include "cli/rig_ports.hpp"

#include "hal/rig/boards/shared_registers.hpp"

namespace twin::cli {

std::string shared_name(const Options& options) {
  return options.rig_name.empty() ? hal::rig::boards::default_shared_name() : options.rig_name;
}

}  // namespace twin::cli
