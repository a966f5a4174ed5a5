#include "cli/rig_ports.hpp"

#include <utility>

#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/boards/shared_registers.hpp"

namespace twin::cli {

namespace rig = hal::rig;

RigPorts ports_of(rig::boards::BoardRegisters& boards, const rig::RigSettings& settings,
                  std::shared_ptr<void> owner) {
  rig::boards::Pci1784Layout layout;
  layout.reset = static_cast<std::uint32_t>(settings.counter_reset_offset);
  return {std::move(owner), std::make_unique<rig::boards::EmulatedPci1716>(boards.pci1716),
          std::make_unique<rig::boards::EmulatedPci1784>(boards.pci1784, layout)};
}

std::string shared_name(const RigArguments& options) {
  return options.name.empty() ? rig::boards::default_shared_name() : options.name;
}

}  // namespace twin::cli
