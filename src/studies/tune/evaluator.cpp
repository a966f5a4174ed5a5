#include "studies/tune/evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

namespace twin::studies::tune {
namespace {

// Costs above all times and errors that a run can have, one above the other.
constexpr double kTooInexact = 1e9;  // times the error over the one to keep
constexpr double kFailed = 1e15;
constexpr double kUnstable = 1e18;  // times what is missing

}  // namespace

double dB(double factor) { return 20.0 * std::log10(factor); }

Expected<batch::PreparedJob> Evaluator::prepare(const std::string& program,
                                                const std::vector<std::string>& settings) {
  batch::Job job;
  job.program = program;
  job.machine = task_.machine;
  job.settings = settings;
  job.feedrate = task_.feedrate;
  const std::lock_guard lock(maker_mutex_);
  return maker_.prepare(job);
}

/// The result of a job from the store, or computed and stored.
Expected<batch::StoredResult> Evaluator::result_of(const batch::PreparedJob& job) {
  if (auto stored = store_.find(job)) {
    ++found_;
    return *std::move(stored);
  }
  batch::Options options;
  options.workers = 1;
  options.stop = stop_;
  batch::StoredResult result;
  options.result = [&result](const batch::PreparedJob&, const batch::StoredResult& computed) {
    result = computed;
  };
  TWIN_CHECK(batch::run_batch(std::span(&job, 1), store_, options));
  ++runs_;
  return result;
}

/// How much of the least margins is missing, as a share of them; 0 where all are kept.
double Evaluator::missing_margins(const Trial& trial) const {
  double missing = 0.0;
  for (const config::LoopMargins& loop : trial.loops) {
    const double gain = loop.gain_margin > 0.0 ? dB(loop.gain_margin) : -60.0;
    missing += std::max(0.0, task_.margins.gain_dB - gain) / std::max(task_.margins.gain_dB, 1.0);
    missing += std::max(0.0, task_.margins.phase_deg - loop.phase_margin_deg) /
               std::max(task_.margins.phase_deg, 1.0);
  }
  return missing;
}

double Evaluator::cost_of(const Trial& trial) const {
  const double error = trial.merit.contour_error;
  if (std::isnan(error) || std::isnan(trial.merit.time)) {
    return kFailed;
  }
  if (task_.aim == Aim::kContourError) {
    return error;
  }
  return error <= task_.largest_error ? trial.merit.time
                                      : kTooInexact * error / task_.largest_error;
}

Expected<Trial> Evaluator::run(Trial trial, const std::vector<std::string>& settings,
                               const std::vector<std::string>& programs, bool is_margin_needed) {
  trial.merit = {0.0, 0.0};
  for (const std::string& program : programs) {
    TWIN_TRY(batch::PreparedJob job, prepare(program, settings));
    if (trial.rows.empty()) {
      const config::MachineFile& machine = job.machine;
      for (std::size_t axis = 0; axis < trial.loops.size(); ++axis) {
        trial.loops[axis] =
            config::loop_margins(machine.servo[axis], machine.table.axis[axis], machine.period);
      }
      if (const double missing = missing_margins(trial); missing > 0.0 && is_margin_needed) {
        trial.cost = kUnstable * (1.0 + missing);
        trial.merit = Trial().merit;
        return trial;
      }
    }
    TWIN_TRY(batch::StoredResult result, result_of(job));
    const batch::Merit merit = batch::merit_of(result);
    trial.merit.time += merit.time;
    trial.merit.contour_error = std::isnan(merit.contour_error)
                                    ? merit.contour_error
                                    : std::max(trial.merit.contour_error, merit.contour_error);
    batch::SweepPoint point{job.job, trial.values};
    if (programs.size() > 1) {
      point.values.insert(point.values.begin(), program);
    }
    job.canonical.clear();
    trial.rows.push_back({std::move(point), std::move(job), batch::figures_of(result)});
  }
  trial.cost = cost_of(trial);
  return trial;
}

std::vector<std::string> Evaluator::settings_of(const std::vector<std::string>& values) const {
  std::vector<std::string> settings = task_.settings;
  for (std::size_t i = 0; i < values.size(); ++i) {
    settings.push_back(task_.keys[i].key + "=" + values[i]);
  }
  return settings;
}

Expected<Trial> Evaluator::run_values(const std::vector<std::string>& values,
                                      const std::vector<std::string>& further,
                                      const std::vector<std::string>& programs) {
  std::vector<std::string> settings = settings_of(values);
  settings.insert(settings.end(), further.begin(), further.end());
  Trial trial;
  trial.values = values;
  return run(std::move(trial), settings, programs, false);
}

Expected<Trial> Evaluator::try_at(std::span<const double> point) {
  Trial trial;
  for (std::size_t i = 0; i < point.size(); ++i) {
    trial.values.push_back(fmt::format("{:.9g}", task_.keys[i].value(point[i])));
  }
  const std::vector<std::string> settings = settings_of(trial.values);
  return run(std::move(trial), settings, task_.programs, true);
}

}  // namespace twin::studies::tune
