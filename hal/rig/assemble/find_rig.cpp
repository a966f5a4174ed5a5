#include "hal/rig/assemble/find_rig.hpp"

#include <fmt/format.h>

#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/daqnavi_library.hpp"
#include "hal/rig/register_cards.hpp"

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

}  // namespace twin::hal::rig::assemble
