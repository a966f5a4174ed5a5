#include "studies/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "library/inside.hpp"
#include "studies/identify/candidates.hpp"
#include "studies/identify/identification_report.hpp"
#include "studies/identify/recording_columns.hpp"

namespace twin {

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
  std::vector<inner::Recording> recordings;
  for (const std::string& trace : traces) {
    std::ranges::move(value_of(inner::read_recordings(trace, columns, machine.limits)),
                      std::back_inserter(recordings));
  }
  const inner::Identification result = value_of(inner::identify(recordings, machine, fit));
  return {Inside::settings(result.machine), inner::to_machine_file(result), inner::to_table(result),
          inner::to_json(result, ""), result.notes};
}

}  // namespace twin
