#include "runtime/recorder.hpp"

#include <cmath>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "results/trace/columns.hpp"

namespace twin::runtime {

Expected<Recorder> Recorder::create(const Options& options, BlockSource blocks) {
  Recorder recorder(options, std::move(blocks));
  TWIN_CHECK(recorder.begin());
  return recorder;
}

Recorder::Recorder(const Options& options, BlockSource blocks)
    : options_(options),
      blocks_(std::move(blocks)),
      layout_(options.has_machine ? results::Layout::kRun : results::Layout::kPlan),
      in_space_(results::View::kSpace),
      along_z_(results::View::kAlongZ),
      fluctuation_(options.period),
      audit_(options.period, options.limits) {}

/// Opens the files and begins the trace in every sink.
Expected<void> Recorder::begin() {
  std::vector<TraceSink*> sinks;
  if (!options_.directory.empty()) {
    csv_ = std::make_unique<results::CsvTrace>(options_.directory, options_.durability);
    sinks.push_back(csv_.get());
  }
  sinks.insert(sinks.end(), options_.sinks.begin(), options_.sinks.end());
  TWIN_CHECK(sinks_.begin(sinks, results::trace_header(layout_, options_.period)));
  if (!options_.directory.empty()) {
    TWIN_TRY(limit_, results::LimitWriter::create(options_.directory / "plots"));
  }
  return {};
}

/// Reads on until no further block can change what the trackers say of this block.
Expected<void> Recorder::read_ahead(std::int64_t block) {
  const auto is_ready = [&] {
    return in_space_.is_ready(block) && (!options_.has_machine || along_z_.is_ready(block));
  };
  while (!program_ended_ && !is_ready()) {
    TWIN_TRY(const std::optional<gcode::Block> next, blocks_());
    if (!next) {
      program_ended_ = true;
      break;
    }
    in_space_.add(*next);
    if (options_.has_machine) {
      along_z_.add(*next);
    }
  }
  return {};
}

Expected<void> Recorder::record(const results::Sample& sample) {
  TWIN_CHECK(read_ahead(sample.block));
  in_space_.follow(sample.block, sample.command);
  command_error_.add(in_space_.nearest(sample.command).distance);
  fluctuation_.add(sample.command, sample.feedrate);
  audit_.add(sample.command);
  double contour_error = 0.0;
  if (options_.has_machine) {
    along_z_.follow(sample.block, sample.command);
    contour_error = along_z_.nearest({sample.encoder.x(), sample.encoder.y(), 0.0}).distance;
    contour_error_.add(contour_error);
    table_error_.add(along_z_.nearest({sample.table.x(), sample.table.y(), 0.0}).distance);
    for (Eigen::Index i = 0; i < 2; ++i) {
      tracking_error_[static_cast<std::size_t>(i)].add(
          std::abs(sample.command[i] - sample.encoder[i]));
    }
    if (!sample.is_passed_over) {
      cycle_time_.add(sample.cycle_time);
    }
    if (options_.is_wall_clock && !sample.is_passed_over) {
      timing_.add(sample);
    }
  }
  ++samples_;
  last_ = sample;
  results::append_row(sample, contour_error, layout_, rows_);
  return limit_ ? limit_->write(sample.t, sample.feedrate_limit) : Expected<void>{};
}

Expected<void> Recorder::flush() {
  if (rows_.empty()) {
    return {};
  }
  auto taken = sinks_.rows(rows_);
  rows_.clear();
  return taken;
}

void Recorder::summarise(results::Summary& summary) {
  const auto figures = [](const results::Running& error) {
    return results::ErrorStats{error.max(), error.rms()};
  };
  summary.command_contour_error = figures(command_error_);
  summary.feedrate_fluctuation = {fluctuation_.shares().max(), fluctuation_.shares().rms()};
  summary.audit = audit_.finish();
  if (!options_.has_machine) {
    return;
  }
  results::MachineResults run;
  run.machining_time = last_.t;
  run.contour_error = figures(contour_error_);
  run.table_contour_error = figures(table_error_);
  run.tracking_error = {figures(tracking_error_[0]), figures(tracking_error_[1])};
  run.cycle_time = {cycle_time_.quantile(0.5), cycle_time_.quantile(0.99), cycle_time_.max()};
  if (options_.is_wall_clock) {
    run.realtime = timing_.figures();
  }
  summary.run = run;
}

Expected<void> Recorder::commit() {
  TWIN_CHECK(flush());
  if (limit_) {
    TWIN_CHECK(commit_timing());
    TWIN_CHECK(limit_->commit());
  }
  return sinks_.commit();
}

/// Writes the histograms of a run on the wall clock, or removes those of an earlier one.
Expected<void> Recorder::commit_timing() const {
  const auto timing = options_.directory / "plots" / results::kTimingName;
  if (options_.has_machine && options_.is_wall_clock) {
    return write_whole_file(timing, timing_.to_csv());
  }
  std::error_code ignored;
  std::filesystem::remove(timing, ignored);
  return {};
}

void Recorder::abandon() noexcept {
  static_cast<void>(flush());
  if (limit_) {
    limit_->abandon();
  }
  sinks_.abandon();
}

}  // namespace twin::runtime
