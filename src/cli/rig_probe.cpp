#include <fmt/format.h>

#include <string>

#include "cli/commands.hpp"
#include "cli/rig_look.hpp"
#include "hal/rig/io_port/find_card.hpp"
#include "hal/rig/rig_view.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;

std::string signal(const rig::Line& line, bool given, const char* yes, const char* no) {
  return line.channel < 0 ? "not wired" : given ? yes : no;
}

void print_cards(const rig::io_port::CardKind& kind, const rig::RigSettings& settings) {
  for (const rig::io_port::CardSeen& card :
       rig::io_port::look_for_cards(kind, settings.access, settings.sysfs)) {
    fmt::print("  {:<10}{}, {}\n", kind.name, card.pci.address,
               card.why.empty() ? fmt::format("board ID {}, {}", card.board_id, to_text(card.port))
                                : card.why);
  }
}

void print_axis(char name, const rig::AxisWiring& wiring, const rig::RigView& view,
                std::size_t axis) {
  const rig::DriveInputs& drive = view.drives[axis];
  fmt::print("  axis {}    DAC {}, counter {}: {} counts\n", name, wiring.dac, wiring.counter,
             view.counts[axis]);
  fmt::print("            ALM {}, servo ready {}, P-OT {}, N-OT {}, V-REF {}\n",
             signal(wiring.alarm, drive.alarm, "ALARM (or wire open)", "no alarm"),
             signal(wiring.ready, drive.ready, "yes", "no"),
             signal(wiring.limit_positive, drive.limit_positive, "REACHED (or wire open)", "free"),
             signal(wiring.limit_negative, drive.limit_negative, "REACHED (or wire open)", "free"),
             view.vref[axis] ? fmt::format("{:.4f} V", *view.vref[axis]) : "not read back");
}

Expected<void> probe(const Options& options) {
  const auto rig_seen = open_to_look(options);
  if (!rig_seen) {
    return tl::unexpected(rig_seen.error());
  }
  const rig::RigSettings& settings = rig_seen->settings;
  fmt::print("rig: {}\n", describe(rig_seen->kind));
  if (rig_seen->kind == RigKind::kCards) {
    print_cards(rig::io_port::kPci1716, settings);
    print_cards(rig::io_port::kPci1784, settings);
  }
  const rig::RigView view =
      rig::look_at_rig(*rig_seen->ports.pci1716, *rig_seen->ports.pci1784, settings);
  fmt::print(
      "  PCI-1716  board ID {}, converters used at +-10 V (their registers cannot be read), "
      "DI {:#06x}\n",
      view.board_id_1716, view.digital);
  fmt::print("  PCI-1784  board ID {}\n", view.board_id_1784);
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    print_axis("xy"[axis], settings.axis[axis], view, axis);
  }
  if (view.board_id_1716 < 0 || view.board_id_1784 < 0) {
    return fail(ErrorCode::kMachine, fmt::format("the PCI-{} does not answer: all its registers "
                                                 "read ones",
                                                 view.board_id_1716 < 0 ? 1716 : 1784));
  }
  return {};
}

}  // namespace

Command add_rig_probe(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app =
      context.app.add_subcommand("probe", "Show cards, inputs and drive states; nothing moves");
  add_machine_options(*app, options);
  add_rig_options(*app, options, false);
  return {app, [&options] { return probe(options); }};
}

}  // namespace twin::cli
