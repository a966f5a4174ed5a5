#include "twin/compensation.hpp"

#include "library/inside.hpp"
#include "runtime/correction_file.hpp"
#include "session/results.hpp"
#include "studies/compensate/learning.hpp"

namespace twin {

Compensation compensate(const Program& program, const Settings& settings, const std::string& file,
                        const CompensationOptions& options) {
  const auto& data = Inside::of(program);
  const config::MachineFile& machine = Inside::of(settings);
  check(session::prepare_output_file(file));
  studies::compensate::CompensateOptions inner;
  inner.stop = options.stop;
  inner.progress = options.progress;
  const auto made =
      value_of(studies::compensate::make_correction(data.source, machine, data.feedrate, inner));
  check(runtime::write_correction(file, made.correction,
                                  runtime::correction_origin(data.source, machine, data.feedrate),
                                  made.remark()));
  const auto& found = made.compensation;
  return {found.before.max, found.after.max, found.before.rms, found.after.rms, found.iterations};
}

}  // namespace twin
