#include "hal/rig/assemble/rig_ports.hpp"

#include <memory>
#include <utility>

#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/io_port/port_address.hpp"
#include "hal/rig/register_cards.hpp"

namespace twin::hal::rig::assemble {

RigPorts ports_of(boards::BoardRegisters& boards, const RigSettings& settings,
                  std::shared_ptr<void> owner) {
  boards::Pci1784Layout layout;
  layout.reset = static_cast<std::uint32_t>(settings.counter_reset_offset);
  return {.owner = std::move(owner),
          .pci1716 = std::make_unique<boards::EmulatedPci1716>(boards.pci1716),
          .pci1784 = std::make_unique<boards::EmulatedPci1784>(boards.pci1784, layout)};
}

Expected<RigPorts> open_to_look(RigKind kind, const RigSetup& setup, double period) {
  if (kind == RigKind::kProcess) {
    TWIN_TRY(std::shared_ptr<boards::SharedRegisters> shared,
             boards::SharedRegisters::attach(setup.shared_name, boards::SharedRole::kObserver));
    return ports_of(shared->boards(), setup.wiring, shared);
  }
  if (kind == RigKind::kEmulated) {
    const auto bench = std::make_shared<emulator::EmulatedRig>(setup.table, setup.wiring);
    TWIN_CHECK(bench->power_on(period));
    bench->advance();
    return ports_of(bench->boards(), setup.wiring, bench);
  }
  TWIN_TRY(const CardsFound found, find_cards(setup.wiring));
  RigPorts ports;
  TWIN_TRY(ports.pci1716, io_port::open_port(found.pci1716.port));
  TWIN_TRY(ports.pci1784, io_port::open_port(found.pci1784.port));
  return ports;
}

RigSettings wiring_to_look_with(RigKind kind, const RigSettings& wiring) {
  RigSettings looking = wiring;
  for (AxisWiring& axis : looking.axis) {
    if (kind != RigKind::kCards && axis.vref_readback < 0) {
      axis.vref_readback = axis.dac;
    }
  }
  return looking;
}

}  // namespace twin::hal::rig::assemble
