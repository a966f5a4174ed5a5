#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/rig_machines.hpp"
#include "core/units.hpp"
#include "session/axis_move.hpp"
#include "session/results.hpp"

namespace twin::cli {
namespace {

Expected<void> jog(const Options& options, const std::atomic<bool>& stop) {
  const auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  if (options.distance_mm == 0.0) {
    return fail(ErrorCode::kUsage, "--distance-mm 0 is no move");
  }
  const session::AxisMove move{"jog", options.axis == "x" ? hal::kX : hal::kY, options.distance_mm,
                               *feedrate_of(options), options.out};
  const auto rig =
      open_rig(options, *machine,
               fmt::format("rig jog --axis {} --distance-mm {:g}", options.axis, move.distance));
  if (!rig) {
    return tl::unexpected(rig.error());
  }
  const auto result = session::make_axis_move(move, *machine, **rig, stop);
  if (!result) {
    return tl::unexpected(result.error());
  }
  if (result->failure) {
    return tl::unexpected(*result->failure);
  }
  if (!options.quiet) {
    const auto& error = result->summary.run->tracking_error[move.axis];
    fmt::print(
        "axis {} jogged by {:g} mm{}: tracking error max {:.1f}, RMS {:.1f} um; trace in {}\n",
        options.axis, move.distance, (*rig)->info().simulated ? " (simulated)" : "",
        units::um_from_mm(error.max), units::um_from_mm(error.rms),
        session::result_folder(options.out, "rig_jog").string());
  }
  return {};
}

}  // namespace

Command add_rig_jog(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app =
      context.app.add_subcommand("jog", "Move one axis from where it stands, in closed loop");
  add_axis_option(*app, options);
  app->add_option("--distance-mm", options.distance_mm, "How far, signed")
      ->required()
      ->check(CLI::Range(-1e4, 1e4))
      ->type_name("D");
  add_feedrate_option(*app, options, "Feedrate");
  app->get_option("--feedrate-mm-per-min")->required();
  add_machine_options(*app, options);
  add_rig_options(*app, options, true);
  app->add_option("--out", options.out, "Folder of the trace [renders/rig_jog]")->type_name("DIR");
  app->add_flag("--quiet", options.quiet, "Print errors only");
  return {app, [&options, &stop = context.stop] { return jog(options, stop); }};
}

}  // namespace twin::cli
