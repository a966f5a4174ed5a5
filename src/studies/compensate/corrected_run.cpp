#include "studies/compensate/corrected_run.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "runtime/correction_file.hpp"

namespace twin::studies::compensate {

Expected<MadeCorrection> CorrectedRun::make(std::vector<Vec2> mismatch,
                                            const CorrectionWatch& watch) const {
  CompensateOptions options;
  options.mismatch = std::move(mismatch);
  options.stop = watch.stop;
  options.progress = watch.progress;
  return make_correction(program_, machine_, feedrate_, options);
}

Expected<CorrectedRun> CorrectedRun::prepare(const CorrectionWish& wish,
                                             const gcode::ProgramText& program,
                                             const config::MachineFile& machine,
                                             const std::optional<double>& feedrate,
                                             const CorrectionWatch& watch) {
  CorrectedRun run;
  if (!wish.is_any()) {
    return run;
  }
  run.learning_ = wish.learning;
  run.program_ = program;
  run.machine_ = machine;
  run.feedrate_ = feedrate;
  std::filesystem::path file = wish.file;
  std::error_code code;
  if (!wish.learning.empty()) {
    std::filesystem::create_directories(wish.learning, code);
    if (code) {
      return file_error(wish.learning, "make this folder", code.value());
    }
    if (const auto learnt = LearningFolder{wish.learning}.correction();
        std::filesystem::exists(learnt, code)) {
      file = learnt;
    }
    run.trace_ = std::make_unique<MemoryTrace>();
  }
  if (!file.empty()) {
    TWIN_TRY(motion::Correction correction,
             runtime::read_correction(file, runtime::correction_origin(program, machine, feedrate),
                                      machine.compensation.limit));
    run.correction_ = std::make_shared<const motion::Correction>(std::move(correction));
  } else {
    TWIN_TRY(MadeCorrection made, run.make({}, watch));
    run.remark_ = made.remark();
    run.correction_ = std::make_shared<const motion::Correction>(std::move(made.correction));
  }
  return run;
}

Expected<std::string> CorrectedRun::learn_from(const CorrectionWatch& watch) {
  if (trace_ == nullptr) {
    return std::string();
  }
  const LearningFolder folder{learning_};
  TWIN_TRY(const auto path,
           ContourPath::plan(program_, runtime::planned_with_reserve(machine_), feedrate_));
  std::vector<Vec2> measured(trace_->size());
  const auto x = (*trace_)["x_enc_mm"];
  const auto y = (*trace_)["y_enc_mm"];
  for (std::size_t k = 0; k < measured.size(); ++k) {
    measured[k] = {x[k], y[k]};
  }
  TWIN_TRY(auto learnt, read_learnt(folder.learnt(), path.points().size()));
  TWIN_CHECK(add_run(machine_, path, measured, correction_->offsets, learnt));
  TWIN_TRY(const MadeCorrection made, make(learnt.mismatch, watch));
  TWIN_CHECK(write_learnt(folder.learnt(), learnt));
  TWIN_CHECK(runtime::write_correction(
      folder.correction(), made.correction,
      runtime::correction_origin(program_, machine_, feedrate_),
      fmt::format("{}; learnt from {} runs", made.remark(), learnt.runs)));
  return fmt::format("learnt from {} {} in {}: the next run follows {}", learnt.runs,
                     learnt.runs == 1 ? "run" : "runs", folder.folder.string(),
                     folder.correction().string());
}

}  // namespace twin::studies::compensate
