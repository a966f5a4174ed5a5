#include "hal/rig/assemble/rig_ports.hpp"

#include <utility>

#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"

namespace twin::hal::rig::assemble {

RigPorts ports_of(boards::BoardRegisters& boards, const RigSettings& settings,
                  std::shared_ptr<void> owner) {
  boards::Pci1784Layout layout;
  layout.reset = static_cast<std::uint32_t>(settings.counter_reset_offset);
  return {.owner = std::move(owner),
          .pci1716 = std::make_unique<boards::EmulatedPci1716>(boards.pci1716),
          .pci1784 = std::make_unique<boards::EmulatedPci1784>(boards.pci1784, layout)};
}

}  // namespace twin::hal::rig::assemble
