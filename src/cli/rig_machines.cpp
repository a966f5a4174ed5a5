#include "cli/rig_machines.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "cli/rig_ports.hpp"
#include "core/atomic_file.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/daqnavi_library.hpp"
#include "hal/rig/emergency.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/emulator/shared_bench.hpp"
#include "hal/rig/guard/guard_process.hpp"
#include "hal/rig/open_cards.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/servopack.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;

rig::TableScales scales_of(const hal::mujoco::TableParams& table) {
  rig::TableScales scales;
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    scales.mm_per_count[axis] = table.axis[axis].encoder.mm_per_count;
    scales.mm_per_s_per_volt[axis] = table.axis[axis].mm_per_s_per_volt();
  }
  return scales;
}

Expected<std::unique_ptr<rig::Cards>> open_boards(rig::boards::BoardRegisters& boards,
                                                  const rig::RigSettings& settings) {
  RigPorts ports = ports_of(boards, settings);
  return rig::RegisterCards::open(std::move(ports.pci1716), std::move(ports.pci1784), settings);
}

/// What happened at the boards, when all is over.
void write_log(rig::emulator::EmulatedRig& emulated, const std::filesystem::path& file) {
  if (file.empty()) {
    return;
  }
  std::string text;
  const rig::emulator::EventLog& events = emulated.events();
  for (std::size_t i = events.first(); i < events.written(); ++i) {
    text += to_string(events[i]) + '\n';
  }
  const rig::boards::Pci1716Registers& card = emulated.boards().pci1716;
  const hal::Truth truth = emulated.truth();
  const bool has_power = card.is_present.load();
  text += fmt::format(
      "plant {:.6f} s: end, table x {:.3f} mm, y {:.3f} mm, {}\n", emulated.time(),
      truth.table_position[hal::kX], truth.table_position[hal::kY],
      has_power ? fmt::format("DAC 0 0x{:04X}, DAC 1 0x{:04X}, digital outputs 0x{:04X}",
                              card.dac[0].load(), card.dac[1].load(), card.digital_out.load())
                : "the PCI-1716 without power");
  if (auto written = write_whole_file(file, text); !written) {
    fmt::print(stderr, "twin: {}\n", to_string(written.error()));
  }
}

/// The guard stands beside the program.
std::filesystem::path guard_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "twin-guard";
}

rig::guard::GuardTarget guard_target(const config::MachineFile& machine, std::string outputs) {
  rig::guard::GuardTarget target;
  target.program = guard_program();
  target.outputs = std::move(outputs);
  target.safe_digital = rig::safe_digital(machine.rig);
  target.timeout = std::chrono::milliseconds(std::lround(machine.safety.heartbeat_timeout * 1e3));
  return target;
}

/// Where the guard finds the outputs of the real cards.
Expected<std::string> outputs_of_cards(const rig::RigSettings& settings) {
  if (settings.driver == rig::Driver::kDaqnavi) {
    return fmt::format("daqnavi:{}:{}", settings.daqnavi_library, settings.pci1716_board_id);
  }
  return rig::find_cards(settings).map(
      [](const rig::CardsFound& found) { return to_text(found.pci1716.port); });
}

std::unique_ptr<rig::RigMachine> make_real_rig(const config::MachineFile& machine) {
  auto guard = std::make_shared<rig::guard::GuardProcess>();
  const auto open = [guard, machine] {
    return outputs_of_cards(machine.rig)
        .and_then([&](const std::string& outputs) {
          return guard->start(guard_target(machine, outputs));
        })
        .and_then([&] { return rig::open_cards(machine.rig); });
  };
  return std::make_unique<rig::RigMachine>(machine.rig, scales_of(machine.table), open, nullptr,
                                           guard.get());
}

Expected<std::unique_ptr<rig::RigMachine>> make_process_rig(const RigArguments& options,
                                                            const config::MachineFile& machine) {
  auto attached = rig::boards::SharedRegisters::attach(shared_name(options),
                                                       rig::boards::SharedRole::kController);
  if (!attached) {
    return tl::unexpected(attached.error());
  }
  const std::shared_ptr<rig::boards::SharedRegisters> shared = std::move(*attached);
  auto guard = std::make_shared<rig::guard::GuardProcess>();
  const auto open = [guard, shared, machine, name = shared_name(options)] {
    return guard->start(guard_target(machine, "shared:" + name)).and_then([&] {
      return open_boards(shared->boards(), machine.rig);
    });
  };
  return std::make_unique<rig::RigMachine>(machine.rig, scales_of(machine.table), open,
                                           std::make_shared<rig::emulator::SharedBench>(shared),
                                           guard.get());
}

Expected<std::unique_ptr<rig::RigMachine>> make_emulated_rig(const RigArguments& options,
                                                             const config::MachineFile& machine) {
  std::vector<rig::emulator::Fault> faults;
  for (const std::string& text : options.faults) {
    auto fault = rig::emulator::parse_fault(text);
    if (!fault) {
      return tl::unexpected(fault.error());
    }
    faults.push_back(*fault);
  }
  const std::shared_ptr<rig::emulator::EmulatedRig> bench(
      new rig::emulator::EmulatedRig(machine.table, machine.rig, std::move(faults)),
      [log = options.log](rig::emulator::EmulatedRig* emulated) {
        write_log(*emulated, log);
        delete emulated;
      });
  const auto open = [bench, settings = machine.rig] {
    return open_boards(bench->boards(), settings);
  };
  return std::make_unique<rig::RigMachine>(machine.rig, scales_of(machine.table), open, bench);
}

/// Whether the real cards can be driven: nothing, or what is missing.
Expected<void> look_for_real_cards(const rig::RigSettings& settings) {
  if (settings.driver == rig::Driver::kDaqnavi) {
    return rig::DaqnaviLibrary::load(settings.daqnavi_library).map([](const auto&) {});
  }
  return rig::find_cards(settings).map([](const auto&) {});
}

}  // namespace

Expected<RigKind> find_rig(const RigArguments& options, const config::MachineFile& machine) {
  if (options.which == "emulated") {
    return RigKind::kEmulated;
  }
  if (options.which == "process") {
    return RigKind::kProcess;
  }
  auto cards = look_for_real_cards(machine.rig);
  const bool has_process =
      options.which == "auto" &&
      rig::boards::SharedRegisters::attach(shared_name(options), rig::boards::SharedRole::kObserver)
          .has_value();
  if (cards && has_process) {
    return fail(ErrorCode::kUsage,
                "there are real cards and an emulator's process: say --rig cards or --rig process");
  }
  if (cards) {
    return RigKind::kCards;
  }
  if (has_process) {
    return RigKind::kProcess;
  }
  if (options.which == "auto") {
    cards.error().message +=
        fmt::format("; nor does an emulator run (twin rig emulate, {})", shared_name(options));
  }
  return tl::unexpected(cards.error());
}

Expected<std::unique_ptr<rig::RigMachine>> make_rig(RigKind kind, const RigArguments& options,
                                                    const config::MachineFile& machine) {
  rig::install_emergency_handlers();
  switch (kind) {
    case RigKind::kCards:
      return make_real_rig(machine);
    case RigKind::kProcess:
      return make_process_rig(options, machine);
    case RigKind::kEmulated:
      break;
  }
  return make_emulated_rig(options, machine);
}

Expected<std::unique_ptr<rig::RigMachine>> assemble_rig(const RigArguments& options,
                                                        const config::MachineFile& machine) {
  TWIN_TRY(const RigKind kind, find_rig(options, machine));
  if (kind != RigKind::kEmulated && (!options.faults.empty() || !options.log.empty())) {
    return fail(ErrorCode::kUsage,
                fmt::format("--fault and --rig-log are for --rig emulated, and this rig is: {}; an "
                            "emulator's process takes --fault by itself",
                            describe(kind)));
  }
  return make_rig(kind, options, machine);
}

hal::MachineInfo machine_info(const config::MachineFile& machine) {
  return rig::RigMachine(machine.rig, scales_of(machine.table), {}).info();
}

std::string describe(RigKind kind) {
  switch (kind) {
    case RigKind::kCards:
      return "real cards";
    case RigKind::kProcess:
      return "emulated boards of another process (simulated)";
    case RigKind::kEmulated:
      break;
  }
  return "emulated boards (simulated)";
}

}  // namespace twin::cli
