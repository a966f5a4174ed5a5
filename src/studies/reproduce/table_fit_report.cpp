#include "studies/reproduce/table_fit_report.hpp"

#include <fmt/format.h>

#include <string_view>

namespace twin::studies::reproduce {
namespace {

/// A parameter whose move by a tenth of its range raises the cost by less says nothing: the same
/// move of the phases alone does as much.
constexpr double kLeastRise = 0.1;

std::string_view verdict(const FittedValue& value) {
  if (value.is_at_bound) {
    return "at the bound of its range";
  }
  return value.rise < kLeastRise ? "the tables hardly tell" : "";
}

}  // namespace

std::string to_table(const TableFit& fit) {
  std::string text = fmt::format(
      "planning.kf = {:.3f}, planning.kp = {:.2f} 1/s: machining times {:.2f} % off (RMS)\n\n",
      fit.machine.planning.kf, fit.machine.planning.kp, 1e2 * fit.time_error);
  text += fmt::format("{:<40}{:>12}{:>12}{:>10}\n", "parameter", "before", "after", "rise");
  for (const FittedValue& value : fit.values) {
    const std::string_view remark = verdict(value);
    text += fmt::format("{:<40}{:>12.5g}{:>12.5g}{:>10.3f}{}{}\n", value.key, value.before,
                        value.after, value.rise, remark.empty() ? "" : "  ", remark);
  }
  return text + fmt::format(
                    "\nrise: of the cost when the parameter is moved by a tenth of its range\n"
                    "cost {:.3f} before, {:.3f} after, over 48 figures:\n"
                    "0 where all are met, 2.8 for each that is far off\n",
                    fit.cost_before, fit.cost_after);
}

}  // namespace twin::studies::reproduce
