#include "cli/identify_tables.hpp"

#include <fmt/core.h>

#include <string_view>

#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "studies/reproduce/table_fit.hpp"

namespace twin::cli {
namespace {

/// A parameter whose move by a tenth of its range raises the cost by less says nothing: the same
/// move of the phases alone does as much.
constexpr double kLeastRise = 0.1;

std::string_view verdict(const studies::reproduce::FittedValue& value) {
  if (value.is_at_bound) {
    return "at the bound of its range";
  }
  return value.rise < kLeastRise ? "the tables hardly tell" : "";
}

void print(const studies::reproduce::TableFit& fit) {
  fmt::print(
      "planning.kf = {:.3f}, planning.kp = {:.2f} 1/s: machining times {:.2f} % off (RMS)\n\n",
      fit.machine.planning.kf, fit.machine.planning.kp, 1e2 * fit.time_error);
  fmt::print("{:<40}{:>12}{:>12}{:>10}\n", "parameter", "before", "after", "rise");
  for (const studies::reproduce::FittedValue& value : fit.values) {
    const std::string_view remark = verdict(value);
    fmt::print("{:<40}{:>12.5g}{:>12.5g}{:>10.3f}{}{}\n", value.key, value.before, value.after,
               value.rise, remark.empty() ? "" : "  ", remark);
  }
  fmt::print(
      "\nrise: of the cost when the parameter is moved by a tenth of its range\n"
      "cost {:.3f} before, {:.3f} after, over 48 figures: 0 where all are met, 2.8 for each that "
      "is far off\n",
      fit.cost_before, fit.cost_after);
}

}  // namespace

Expected<void> identify_tables(const IdentifyTables& request, const std::atomic<bool>& stop) {
  const auto published = studies::reproduce::published();
  if (!published) {
    return tl::unexpected(published.error());
  }
  Expected<studies::reproduce::TableFit> fit;
  {
    Progress progress("fitting the published tables", request.quiet);
    studies::reproduce::TableFitOptions options;
    options.evaluations = request.evaluations;
    options.seed = request.seed;
    options.stop = &stop;
    options.progress = [show = progress.callback()](double share, double) { show(share); };
    fit = studies::reproduce::fit_tables(*published, request.start, options);
  }
  if (!fit) {
    return tl::unexpected(fit.error());
  }
  if (auto written = write_whole_file(request.out, config::to_toml(fit->machine)); !written) {
    return written;
  }
  if (!request.quiet) {
    print(*fit);
    fmt::print("machine file: {}\n", request.out.string());
  }
  if (fit->was_stopped) {
    return fail(ErrorCode::kInterrupted, "interrupted: the machine file has the best so far");
  }
  return {};
}

}  // namespace twin::cli
