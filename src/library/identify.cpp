#include "studies/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "library/inside.hpp"
#include "studies/identify/candidates.hpp"
#include "studies/identify/identification_report.hpp"
#include "studies/identify/recording_columns.hpp"

namespace twin {
namespace {

std::vector<studies::identify::Recording> recordings_of(const std::vector<std::string>& traces,
                                                        const studies::identify::ColumnMap& columns,
                                                        const config::MachineFile& machine) {
  std::vector<studies::identify::Recording> recordings;
  for (const std::string& trace : traces) {
    std::ranges::move(value_of(studies::identify::read_recordings(trace, columns, machine.limits)),
                      std::back_inserter(recordings));
  }
  return recordings;
}

std::vector<Validation> validations_of(const studies::identify::Identification& result) {
  std::vector<Validation> list;
  for (const studies::identify::Validation& one : result.validations) {
    Validation& validation = list.emplace_back();
    validation.trace = one.trace;
    validation.axis = one.axis == hal::kX ? "x" : "y";
    validation.is_held_out = one.is_held_out;
    validation.tracking_rms = one.tracking.rms;
    validation.twin_rms = one.twin.rms;
    validation.twin_max = one.twin.max;
    validation.delay_rms = one.delay.rms;
    validation.filter_rms = one.filter.rms;
    if (one.force && one.force->measured_rms > 0.0) {
      validation.force_error = one.force->twin.rms / one.force->measured_rms;
    }
  }
  return list;
}

}  // namespace

Identification identify(const std::vector<std::string>& traces, const Settings& start,
                        const IdentifyOptions& options) {
  namespace inner = studies::identify;
  const config::MachineFile& machine = Inside::of(start);
  inner::FitOptions fit;
  fit.evaluations = options.evaluations > 0 ? options.evaluations : fit.evaluations;
  fit.seed = options.seed;
  fit.fixed = value_of(inner::full_keys(options.fixed, machine));
  fit.freed = value_of(inner::full_keys(options.freed, machine));
  fit.stop = options.stop;
  fit.progress = options.progress;
  const auto columns = value_of(inner::parse_columns(options.columns));
  auto recordings = recordings_of(traces, columns, machine);
  for (inner::Recording& recording : recordings_of(options.at_table, columns, machine)) {
    recording.is_at_table = true;
    recordings.push_back(std::move(recording));
  }
  const auto validating = recordings_of(options.validating, columns, machine);
  const inner::Identification result =
      value_of(inner::identify(recordings, machine, fit, validating));
  return {Inside::settings(result.machine), inner::to_machine_file(result), inner::to_table(result),
          inner::to_json(result, ""),       validations_of(result),         result.notes};
}

}  // namespace twin
