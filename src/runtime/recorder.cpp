#include "runtime/recorder.hpp"

#include <cmath>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "results/trace/columns.hpp"

namespace twin::runtime {

Expected<Recorder> Recorder::create(const Options& options) {
  auto reader = gcode::Reader::open(options.program.string(), options.reader);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  auto trace = results::CsvWriter::create(
      options.directory, options.has_machine ? results::Layout::kRun : results::Layout::kPlan);
  if (!trace) {
    return tl::unexpected(trace.error());
  }
  auto limit = results::LimitWriter::create(options.directory / "plots");
  if (!limit) {
    return tl::unexpected(limit.error());
  }
  return Recorder(options, std::move(*reader), std::move(*trace), std::move(*limit));
}

Recorder::Recorder(const Options& options, gcode::Reader&& reader, results::CsvWriter&& trace,
                   results::LimitWriter&& limit)
    : options_(options),
      reader_(std::move(reader)),
      trace_(std::move(trace)),
      limit_(std::move(limit)),
      in_space_(results::View::kSpace),
      along_z_(results::View::kAlongZ),
      fluctuation_(options.period),
      audit_(options.period, options.limits) {}

/// Reads on until no further block can change what the trackers say of this block.
Expected<void> Recorder::read_ahead(std::int64_t block) {
  const auto is_ready = [&] {
    return in_space_.is_ready(block) && (!options_.has_machine || along_z_.is_ready(block));
  };
  while (!program_ended_ && !is_ready()) {
    auto next = reader_.next();
    if (!next) {
      return tl::unexpected(next.error());
    }
    if (!next->has_value()) {
      program_ended_ = true;
      break;
    }
    in_space_.add(**next);
    if (options_.has_machine) {
      along_z_.add(**next);
    }
  }
  return {};
}

Expected<void> Recorder::take(const results::Sample& sample) {
  if (auto ready = read_ahead(sample.block); !ready) {
    return ready;
  }
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
  if (auto written = limit_.write(sample.t, sample.feedrate_limit); !written) {
    return written;
  }
  return trace_.write(sample, contour_error);
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
  const auto timing = options_.directory / "plots" / results::kTimingName;
  if (options_.has_machine && options_.is_wall_clock) {
    if (auto written = write_whole_file(timing, timing_.to_csv()); !written) {
      return written;
    }
  } else {
    std::error_code ignored;
    std::filesystem::remove(timing, ignored);  // of an earlier run
  }
  if (auto done = limit_.commit(); !done) {
    return done;
  }
  return trace_.commit();
}

void Recorder::abandon() noexcept {
  limit_.abandon();
  trace_.abandon();
}

}  // namespace twin::runtime
