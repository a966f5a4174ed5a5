#include "runtime/recorder.hpp"

#include <algorithm>
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
      columns_(!options.columns.empty()
                   ? options.columns
                   : results::columns_of(options.has_machine ? results::Layout::kRun
                                                             : results::Layout::kPlan)),
      in_space_(results::View::kSpace),
      along_z_(results::View::kAlongZ),
      fluctuation_(options.period),
      audit_(options.period, options.limits) {
  results::for_each_peak([](std::int64_t& noted) { noted = -1; }, noted_);
}

/// Opens the files and begins the trace in every sink.
Expected<void> Recorder::begin() {
  std::vector<TraceSink*> sinks;
  const results::TraceFiles files =
      options_.directory.empty() ? results::TraceFiles::kNone : options_.trace;
  if (results::has_csv(files)) {
    csv_ = std::make_unique<results::CsvTrace>(options_.directory, options_.durability);
    sinks.push_back(csv_.get());
  }
  if (results::has_hdf5(files)) {
    hdf5_ = std::make_unique<results::Hdf5Trace>(options_.directory, options_.origin,
                                                 options_.durability);
    sinks.push_back(hdf5_.get());
  }
  sinks.insert(sinks.end(), options_.sinks.begin(), options_.sinks.end());
  TWIN_CHECK(sinks_.begin(sinks, results::trace_header(columns_, options_.period)));
  if (files != results::TraceFiles::kNone) {
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
    largest_feedrate_ = std::max(largest_feedrate_, next->feedrate);
    facts_.push_back({next->motion == gcode::Motion::kRapid, next->program_zero});
    if (options_.has_machine) {
      along_z_.add(*next);
    }
  }
  return {};
}

/// Numbers must not fall.
Recorder::BlockFacts Recorder::facts_of(std::int64_t block) {
  while (first_fact_ < block && facts_.size() > 1) {
    facts_.pop_front();
    ++first_fact_;
  }
  return facts_.empty() ? BlockFacts{} : facts_.front();
}

/// An error with the sign of the side of the path on which the position is.
///
/// @param from_path  position less nearest point of the path, seen along Z [mm]
double Recorder::signed_error(double size, const Vec2& from_path) const noexcept {
  const double side = direction_.x() * from_path.y() - direction_.y() * from_path.x();
  return side < 0.0 ? -size : size;
}

/// Errors of the next sample, whose block the trackers know.
results::SampleErrors Recorder::errors_of(const results::Sample& sample,
                                          results::Deviations& deviations) {
  const auto measure = [&](const results::ContourTracker& tracker, const Vec3& position,
                           double& with_sign) {
    const results::NearestPoint nearest = tracker.nearest(position);
    with_sign = signed_error(nearest.distance, (position - nearest.point).head<2>());
    return nearest.distance;
  };
  results::SampleErrors errors;
  in_space_.follow(sample.block, sample.command);
  errors.command = measure(in_space_, sample.command, deviations.signed_command_error);
  if (options_.has_machine) {
    along_z_.follow(sample.block, sample.command);
    errors.encoder = measure(along_z_, {sample.encoder.x(), sample.encoder.y(), 0.0},
                             deviations.signed_contour_error);
    errors.table =
        measure(along_z_, {sample.table.x(), sample.table.y(), 0.0}, deviations.signed_table_error);
    deviations.contour_error = errors.encoder;
    for (Eigen::Index i = 0; i < 2; ++i) {
      errors.tracking[static_cast<std::size_t>(i)] =
          std::abs(sample.command[i] - sample.encoder[i]);
    }
  }
  return errors;
}

/// Takes the set point to the audit, and keeps the places of new peaks.
void Recorder::audit(const results::Sample& sample) {
  recent_[static_cast<std::size_t>(samples_) % recent_.size()] = {sample.t, sample.command,
                                                                  sample.line, sample.segment};
  audit_.add(sample.command);
  note_peaks();
}

void Recorder::note_peaks() {
  static_assert(results::LimitAudit::kOldest < 64);
  results::for_each_peak(
      [this](const std::int64_t& where, std::int64_t& noted, std::optional<results::Place>& place) {
        if (where != noted) {
          noted = where;
          const std::int64_t last =
              std::clamp<std::int64_t>(where, 0, std::max<std::int64_t>(samples_, 0));
          place = recent_[static_cast<std::size_t>(last) % recent_.size()];
        }
      },
      audit_.where(), noted_, peaks_at_);
}

Expected<void> Recorder::record(const results::Sample& sample) {
  TWIN_CHECK(read_ahead(sample.block));
  if (samples_ > 0) {
    const Vec3 way = sample.command - last_.command;
    path_length_ += way.norm();
    if (const double length = way.head<2>().norm(); length > 0.0) {
      direction_ = way.head<2>() / length;
    }
  }
  results::Deviations deviations;
  deviations.path_length = path_length_;
  const BlockFacts facts = facts_of(sample.block);
  deviations.is_rapid = facts.is_rapid;
  deviations.pen_up = facts.program_zero + results::kPenUp;
  program_zero_.add(sample.t, facts.program_zero);
  const results::SampleErrors errors = errors_of(sample, deviations);
  const results::Place place{sample.t, sample.command, sample.line, sample.segment};
  all_.add(errors, place);
  if (!deviations.is_rapid) {
    no_rapids_.add(errors, place);
    if (sample.command.z() <= deviations.pen_up) {
      pen_down_.add(errors, place);
    }
  }
  fluctuation_.add(sample.command, sample.feedrate);
  audit(sample);
  if (options_.has_machine && !sample.is_passed_over) {
    cycle_time_.add(sample.cycle_time);
    if (options_.is_wall_clock) {
      timing_.add(sample);
    }
  }
  ++samples_;
  last_ = sample;
  results::append_row(sample, deviations, columns_, rows_);
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

/// Figures of the cutting motion, if there was any.
std::optional<results::CuttingStats> Recorder::cutting() const {
  const results::MotionFigures& figures = pen_down_.command.count() > 0 ? pen_down_ : no_rapids_;
  if (figures.command.count() == 0) {
    return std::nullopt;
  }
  results::CuttingStats cutting;
  // The first set point, at rest, has no period before it.
  cutting.time = std::min(static_cast<double>(figures.command.count()) * options_.period, last_.t);
  cutting.command_contour_error = figures.command.stats();
  if (options_.has_machine) {
    cutting.run =
        results::CuttingErrors{figures.encoder.stats(),
                               figures.table.stats(),
                               {figures.tracking[0].stats(), figures.tracking[1].stats()}};
  }
  return cutting;
}

void Recorder::summarise(results::Summary& summary) {
  summary.command_contour_error = all_.command.stats();
  summary.feedrate_fluctuation = {fluctuation_.shares().max(), fluctuation_.shares().rms()};
  summary.audit = audit_.finish();
  --samples_;  // a place beyond the last set point is the last set point's
  note_peaks();
  ++samples_;
  if (samples_ > 0) {
    summary.audit_at = peaks_at_;
  }
  summary.cutting = cutting();
  summary.program_zero = program_zero_;
  if (!options_.has_machine) {
    return;
  }
  results::MachineResults run;
  run.machining_time = last_.t;
  run.contour_error = all_.encoder.stats();
  run.table_contour_error = all_.table.stats();
  run.tracking_error = {all_.tracking[0].stats(), all_.tracking[1].stats()};
  run.cycle_time = {cycle_time_.quantile(0.5), cycle_time_.quantile(0.99), cycle_time_.max()};
  if (options_.is_wall_clock) {
    run.realtime = timing_.figures();
  }
  summary.run = run;
}

void Recorder::describe(const results::Summary& summary) {
  if (hdf5_) {
    hdf5_->set_summary(results::to_reproducible_json(summary));
  }
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
