#include "hal/rig/assemble/make_rig.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "hal/rig/assemble/rig_ports.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/cards.hpp"
#include "hal/rig/daqnavi_library.hpp"
#include "hal/rig/emergency.hpp"
#include "hal/rig/emulator/shared_bench.hpp"
#include "hal/rig/guard/guard_process.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/servopack.hpp"

namespace twin::hal::rig::assemble {
namespace {

/// Whether the real cards can be driven: nothing, or what is missing.
Expected<void> look_for_real_cards(const RigSettings& wiring) {
  if (wiring.driver == Driver::kDaqnavi) {
    return DaqnaviLibrary::load(wiring.daqnavi_library).map([](const auto&) {});
  }
  return find_cards(wiring).map([](const auto&) {});
}

bool has_emulator(const std::string& shared_name) {
  return boards::SharedRegisters::attach(shared_name, boards::SharedRole::kObserver).has_value();
}

TableScales scales_of(const mujoco::TableParams& table) {
  TableScales scales;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    scales.mm_per_count[axis] = table.axis[axis].encoder.mm_per_count;
    scales.mm_per_s_per_volt[axis] = table.axis[axis].mm_per_s_per_volt();
  }
  return scales;
}

Expected<std::unique_ptr<Cards>> open_boards(boards::BoardRegisters& boards,
                                             const RigSettings& wiring) {
  RigPorts ports = ports_of(boards, wiring);
  return RegisterCards::open(std::move(ports.pci1716), std::move(ports.pci1784), wiring);
}

guard::GuardTarget guard_target(const RigSetup& setup, std::string outputs) {
  return {.program = setup.guard_program,
          .outputs = std::move(outputs),
          .safe_digital = safe_digital(setup.wiring),
          .timeout = std::chrono::milliseconds(std::lround(setup.heartbeat_timeout * 1e3))};
}

/// Where the guard finds the outputs of the real cards.
Expected<std::string> outputs_of_cards(const RigSettings& wiring) {
  if (wiring.driver == Driver::kDaqnavi) {
    return fmt::format("daqnavi:{}:{}", wiring.daqnavi_library, wiring.pci1716_board_id);
  }
  return find_cards(wiring).map(
      [](const CardsFound& found) { return to_text(found.pci1716.port); });
}

std::unique_ptr<RigMachine> make_real_rig(const RigSetup& setup) {
  auto guard = std::make_shared<guard::GuardProcess>();
  const auto open = [guard, setup]() -> Expected<std::unique_ptr<Cards>> {
    TWIN_TRY(const std::string outputs, outputs_of_cards(setup.wiring));
    TWIN_CHECK(guard->start(guard_target(setup, outputs)));
    return open_cards(setup.wiring);
  };
  return std::make_unique<RigMachine>(setup.wiring, scales_of(setup.table), open, nullptr,
                                      guard.get());
}

Expected<std::unique_ptr<RigMachine>> make_process_rig(const RigSetup& setup) {
  TWIN_TRY(std::shared_ptr<boards::SharedRegisters> shared,
           boards::SharedRegisters::attach(setup.shared_name, boards::SharedRole::kController));
  auto guard = std::make_shared<guard::GuardProcess>();
  const auto open = [guard, shared, setup]() -> Expected<std::unique_ptr<Cards>> {
    TWIN_CHECK(guard->start(guard_target(setup, "shared:" + setup.shared_name)));
    return open_boards(shared->boards(), setup.wiring);
  };
  return std::make_unique<RigMachine>(setup.wiring, scales_of(setup.table), open,
                                      std::make_shared<emulator::SharedBench>(shared), guard.get());
}

}  // namespace

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

Expected<RigKind> find_rig(const std::string& wanted, const RigSettings& wiring,
                           const std::string& shared_name) {
  if (wanted == "emulated") {
    return RigKind::kEmulated;
  }
  if (wanted == "process") {
    return RigKind::kProcess;
  }
  const bool is_open = wanted == "auto";
  auto cards = look_for_real_cards(wiring);
  const bool has_process = is_open && has_emulator(shared_name);
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
  if (is_open) {
    cards.error().message +=
        fmt::format("; nor does an emulator run (twin rig emulate, {})", shared_name);
  }
  return tl::unexpected(std::move(cards).error());
}

std::unique_ptr<RigMachine> make_emulated_rig(RigSetup setup) {
  const std::shared_ptr<emulator::EmulatedRig> bench(
      new emulator::EmulatedRig(setup.table, setup.wiring, std::move(setup.faults)),
      [at_end = std::move(setup.at_end)](emulator::EmulatedRig* emulated) {
        if (at_end) {
          at_end(*emulated);
        }
        delete emulated;
      });
  const auto open = [bench, wiring = setup.wiring] { return open_boards(bench->boards(), wiring); };
  return std::make_unique<RigMachine>(setup.wiring, scales_of(setup.table), open, bench);
}

Expected<std::unique_ptr<RigMachine>> make_rig(RigKind kind, RigSetup setup) {
  install_emergency_handlers();
  switch (kind) {
    case RigKind::kCards:
      return make_real_rig(setup);
    case RigKind::kProcess:
      return make_process_rig(setup);
    case RigKind::kEmulated:
      break;
  }
  return make_emulated_rig(std::move(setup));
}

MachineInfo rig_info(const RigSettings& wiring, const mujoco::TableParams& table) {
  return RigMachine(wiring, scales_of(table), {}).info();
}

}  // namespace twin::hal::rig::assemble
