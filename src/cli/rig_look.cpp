#include "cli/rig_look.hpp"

#include <memory>
#include <utility>

#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/io_port/port_address.hpp"
#include "hal/rig/register_cards.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;

Expected<RigPorts> open_ports(RigKind kind, const RigArguments& options,
                              const config::MachineFile& machine) {
  if (kind == RigKind::kProcess) {
    return rig::boards::SharedRegisters::attach(shared_name(options),
                                                rig::boards::SharedRole::kObserver)
        .map([&](std::shared_ptr<rig::boards::SharedRegisters> shared) {
          return ports_of(shared->boards(), machine.rig, shared);
        });
  }
  if (kind == RigKind::kEmulated) {
    const auto bench = std::make_shared<rig::emulator::EmulatedRig>(machine.table, machine.rig);
    return bench->power_on(machine.period).map([&] {
      bench->advance();
      return ports_of(bench->boards(), machine.rig, bench);
    });
  }
  const auto found = rig::find_cards(machine.rig);
  if (!found) {
    return tl::unexpected(found.error());
  }
  RigPorts ports;
  for (const auto& [card, port] :
       {std::pair(&found->pci1716, &ports.pci1716), std::pair(&found->pci1784, &ports.pci1784)}) {
    auto opened = rig::io_port::open_port(card->port);
    if (!opened) {
      return tl::unexpected(std::move(opened.error()));
    }
    *port = std::move(*opened);
  }
  return ports;
}

rig::RigSettings settings_to_look_with(RigKind kind, const config::MachineFile& machine) {
  rig::RigSettings settings = machine.rig;
  for (rig::AxisWiring& axis : settings.axis) {
    if (kind != RigKind::kCards && axis.vref_readback < 0) {
      axis.vref_readback = axis.dac;
    }
  }
  return settings;
}

}  // namespace

Expected<RigToLookAt> open_to_look(const RigArguments& options, config::MachineFile machine) {
  TWIN_TRY(const RigKind kind, find_rig(options, machine));
  TWIN_TRY(RigPorts ports, open_ports(kind, options, machine));
  auto settings = settings_to_look_with(kind, machine);
  return RigToLookAt{std::move(machine), kind, std::move(settings), std::move(ports)};
}

}  // namespace twin::cli
