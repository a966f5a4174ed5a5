#include "studies/reproduce/table_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "config/find_file.hpp"
#include "config/machine_file.hpp"
#include "core/must_finish.hpp"
#include "core/parallel_for.hpp"
#include "core/sha256.hpp"
#include "core/stop_wish.hpp"
#include "core/units.hpp"
#include "studies/identify/parameter.hpp"
#include "studies/identify/search_checkpoint.hpp"
#include "studies/identify/table_run.hpp"
#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction.hpp"
#include "studies/search/minimise.hpp"

namespace twin::studies::reproduce {
namespace {

/// What fit_tables() looks for, with the ranges it looks in.
std::vector<studies::identify::Parameter> table_parameters() {
  using studies::identify::Scale;
  std::vector<studies::identify::Parameter> list;
  for (const std::string axis : {"x", "y"}) {
    const std::string table = "table." + axis + ".";
    list.push_back({table + "coulomb_friction_N", 0.5, 80.0, Scale::kLogarithmic});
    list.push_back({table + "static_friction_ratio", 1.0, 2.5, Scale::kLinear});
    list.push_back({table + "stribeck_velocity_mm_per_s", 0.3, 20.0, Scale::kLogarithmic});
    list.push_back({table + "bristle_stiffness_N_per_um", 0.03, 30.0, Scale::kLogarithmic});
    list.push_back({table + "bristle_damping_N_s_per_m", 20.0, 3000.0, Scale::kLogarithmic});
    list.push_back({table + "viscous_friction_N_s_per_m", 0.5, 60.0, Scale::kLogarithmic});
    list.push_back({table + "velocity_gain_Hz", 15.0, 300.0, Scale::kLogarithmic});
    list.push_back({table + "integral_time_ms", 1.0, 30.0, Scale::kLogarithmic});
    list.push_back({table + "current_lag_ms", 0.1, 1.0, Scale::kLinear});
    list.push_back({table + "output_delay_ms", 0.05, 1.0, Scale::kLinear});
    list.push_back({table + "encoder_um_per_count", 0.5, 16.0, Scale::kLogarithmic});
    list.push_back({table + "hum_amplitude_mV", 0.0, 60.0, Scale::kLinear});
    list.push_back({table + "vref_offset_mV", -15.0, 15.0, Scale::kLinear});
    const std::string servo = "servo." + axis + ".";
    list.push_back({servo + "kp_per_s", 40.0, 300.0, Scale::kLogarithmic});
    list.push_back({servo + "kf", 0.97, 1.03, Scale::kLinear});
    list.push_back({servo + "ka_s", 0.0, 0.005, Scale::kLinear});
  }
  return list;
}

using config::MachineFile;
using studies::identify::RunErrors;
using studies::identify::TableRun;

constexpr double kLargestKf = 0.6;  // of the planning model, that is tried
constexpr int kBitsOfKf = 12;       // a few thousandths
constexpr std::size_t kErrors = 6;  // of a row: all columns but the time, which comes last
constexpr std::size_t kPopulation = 16;
constexpr unsigned kAllCores = 0;
constexpr double kMoved = 0.1;  // of a range, to see whether a parameter matters

/// The measured rows with their programs and the settings they are run with.
class Rows {
 public:
  static Expected<Rows> create(const Published& published) {
    Rows rows;
    for (const PublishedRow& row : published.rows) {
      if (!is_measured(row.table)) {
        continue;
      }
      TWIN_TRY(const std::filesystem::path file, config::find_program(row.program + ".nc"));
      TWIN_TRY(gcode::ProgramText program, gcode::ProgramText::read(file));
      rows.rows_.push_back({row, std::move(program)});
    }
    return rows;
  }

  /// Plans every row with the planning keys of a machine file.
  Expected<std::vector<TableRun>> plan(const MachineFile& machine) const {
    std::vector<Expected<TableRun>> planned(rows_.size());
    parallel_for(rows_.size(), [&](std::size_t i) {
      MachineFile file = machine;
      std::vector<std::string> settings = rows_[i].row.settings;
      settings.push_back("path.curves=" + rows_[i].row.interpolator);
      if (auto set = config::apply_overrides(file, settings); !set) {
        planned[i] = tl::unexpected(set.error());
        return;
      }
      planned[i] =
          TableRun::plan(rows_[i].program, file,
                         units::mm_per_s_from_mm_per_min(rows_[i].row.feedrate_mm_per_min));
    });
    std::vector<TableRun> runs;
    for (auto& one : planned) {
      TWIN_TRY(TableRun run, std::move(one));
      runs.push_back(std::move(run));
    }
    return runs;
  }

  std::size_t size() const { return rows_.size(); }
  /// Published numbers of a row, in the order of columns_of().
  const std::vector<double>& values(std::size_t i) const { return rows_[i].row.values; }

 private:
  struct Row {
    PublishedRow row;
    gcode::ProgramText program;
  };
  std::vector<Row> rows_;
};

std::array<double, kErrors> errors_um(const RunErrors& e) {
  std::array<double, kErrors> errors{e.contour_max, e.contour_rms, e.axis_max[0],
                                     e.axis_rms[0], e.axis_max[1], e.axis_rms[1]};
  std::ranges::for_each(errors, [](double& x) { x = units::um_from_mm(x); });
  return errors;
}

/// Root mean square of machining time / published - 1.
double time_error(const Rows& rows, const std::vector<TableRun>& runs) {
  double sum = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    sum += std::pow(runs[i].machining_time() / rows.values(i).back() - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(runs.size()));
}

/// A stage of the search.
struct Stage {
  double share;   // of the evaluations
  double spread;  // first standard deviation, of each range
  std::size_t repeats;
  double (*cost)(double ours, double published);
  double weight_of_first;  // of the costs of the first run alone
  double physics_step;     // at least so long [s]
};
constexpr Stage kWide{0.6, 0.12, 1, smooth_cost, 0.0, 0.125e-3};
constexpr Stage kNear{0.4, 0.05, 3, share_cost, 0.4, 0.0};

/// @param stop     if set, the rest is left out and the cost says nothing; may be null
/// @param threads  0: one for each core
double cost_of(const Rows& rows, const std::vector<TableRun>& runs, const MachineFile& machine,
               const Stage& stage, const std::atomic<bool>* stop, unsigned threads) {
  const std::size_t n = stage.repeats;
  std::vector<std::array<double, kErrors>> errors(runs.size() * n);
  parallel_for(
      errors.size(),
      [&](std::size_t i) {
        if (stop != nullptr && stop->load()) {
          return;
        }
        MachineFile file = machine;
        file.table = with_phases_of_repeat(machine.table, static_cast<int>(i % n));
        file.table.physics_step = std::max(file.table.physics_step, stage.physics_step);
        errors[i] = errors_um(runs[i / n].run(file));
      },
      threads);
  double cost = 0.0;
  for (std::size_t row = 0; row < runs.size(); ++row) {
    for (std::size_t k = 0; k < kErrors; ++k) {
      double mean = 0.0;
      for (std::size_t repeat = 0; repeat < n; ++repeat) {
        mean += errors[row * n + repeat][k] / static_cast<double>(n);
      }
      cost += stage.cost(mean, rows.values(row)[k]) +
              stage.weight_of_first * stage.cost(errors[row * n][k], rows.values(row)[k]);
    }
  }
  return cost;
}

MachineFile with_planning_kf(const MachineFile& machine, double kf) {
  MachineFile file = machine;
  file.planning.kp = machine.planning.kp / (1.0 - machine.planning.kf) * (1.0 - kf);
  file.planning.kf = kf;
  return file;
}

/// The machine with the planning model whose machining times fit best.
Expected<MachineFile> fit_planning(const Rows& rows, const MachineFile& start) {
  Expected<MachineFile> result = start;
  const auto error = [&](double kf) {
    const auto runs = rows.plan(with_planning_kf(start, kf));
    if (!runs) {
      result = tl::unexpected(runs.error());
      return std::numeric_limits<double>::max();
    }
    return time_error(rows, *runs);
  };
  const double kf = boost::math::tools::brent_find_minima(error, 0.0, kLargestKf, kBitsOfKf).first;
  return result ? with_planning_kf(start, kf) : result;
}

using Cost = std::function<double(std::span<const double>, const Stage&, unsigned)>;

/// What names a search, its checkpoint, and how it is done.
struct StagedSearch {
  const std::string& name;
  const std::optional<studies::identify::Checkpoint>& checkpoint;
  const TableFitOptions& options;
};

/// A text that no fit with another result has.
std::string name_of_fit(const MachineFile& start, const TableFitOptions& options) {
  return fmt::format("tables, seed {}, {} evaluations, start {:.12}", options.seed,
                     options.evaluations, sha256(config::to_toml(start)));
}

/// How one stage searches; its checkpoints go to the file of the options, where there is one.
studies::search::MinimiseOptions options_of_stage(const StagedSearch& search, int number,
                                                  std::optional<Error>& failure) {
  const Stage& stage = number == 0 ? kWide : kNear;
  studies::search::MinimiseOptions options;
  options.spread = stage.spread;
  options.population = kPopulation;
  options.evaluations =
      static_cast<std::size_t>(stage.share * static_cast<double>(search.options.evaluations));
  options.seed = search.options.seed;
  options.threads = kAllCores;
  options.stop = search.options.stop;
  if (search.checkpoint && search.checkpoint->stage == number) {
    options.resumed = search.checkpoint->state;
  }
  if (!search.options.checkpoint.empty()) {
    options.save = [&search, &failure, number](const studies::search::SearchState& state) {
      const auto written = studies::identify::write_checkpoint(search.options.checkpoint,
                                                               {search.name, number, state});
      if (!written && !failure) {
        failure = written.error();
      }
    };
  }
  return options;
}

/// Searches stage after stage, from x to x; those before that of the checkpoint are left out.
Expected<void> search_in_stages(const Cost& cost, const StagedSearch& search,
                                std::vector<double>& x, TableFit& fit) {
  double done = 0.0;
  for (int number = 0; number < 2; ++number) {
    const Stage& stage = number == 0 ? kWide : kNear;
    std::optional<Error> failure;
    studies::search::MinimiseOptions options = options_of_stage(search, number, failure);
    options.start = x;
    if (search.options.progress) {
      options.progress = [&, begin = done](double share, double least) {
        search.options.progress(begin + share * stage.share, least);
      };
    }
    done += stage.share;
    if (search.checkpoint && number < search.checkpoint->stage) {
      continue;
    }
    const double before = number == 0 ? cost(x, kWide, kAllCores) : fit.cost_before;
    const auto best = studies::search::minimise(
        [&](std::span<const double> at) { return cost(at, stage, 1); }, options);
    if (failure) {
      return tl::unexpected(*failure);
    }
    if (!best.x.empty()) {
      x = best.x;
      fit.cost_after = best.cost;
    }
    if (best.was_stopped) {
      fit.was_stopped = true;
      fit.cost_before = before;
      break;
    }
  }
  return {};
}

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

double smooth_cost(double ours, double published) {
  const double e2 = std::pow(std::log(ours / published), 2);
  if (!std::isfinite(e2)) {
    return std::numeric_limits<double>::infinity();
  }
  return 0.5 * e2 / (e2 + 0.15 * 0.15) + 0.5 * e2 / (e2 + 0.28 * 0.28) + 0.05 * e2;
}

double share_cost(double ours, double published) {
  const auto step = [](double x) { return 1.0 / (1.0 + std::exp(-x / 0.02)); };
  const double d = std::abs(ours / published - 1.0);
  return step(d - 0.19) + 0.8 * step(d - 0.285) + 0.25 * smooth_cost(ours, published);
}

Expected<TableFit> fit_tables(const Published& published, const MachineFile& start,
                              const TableFitOptions& options) {
  const std::string name = name_of_fit(start, options);
  TWIN_TRY(const auto checkpoint, studies::identify::read_checkpoint(options.checkpoint, name));
  TWIN_TRY(const Rows rows, Rows::create(published));
  TWIN_TRY(const auto parameters, studies::identify::ParameterSet::create(table_parameters()));
  TWIN_TRY(const MachineFile planned, fit_planning(rows, start));
  TWIN_TRY(const std::vector<TableRun> runs, rows.plan(planned));
  const auto cost = [&](std::span<const double> x, const Stage& stage, unsigned threads) {
    return cost_of(rows, runs, parameters.with_units(planned, x), stage, options.stop, threads);
  };
  TableFit fit;
  fit.was_resumed = checkpoint.has_value();
  std::vector<double> x = parameters.units(planned);
  fit.cost_before = cost(x, kNear, kAllCores);
  TWIN_CHECK(check_wish(options.stop, "interrupted: nothing was written"));
  const MustFinish finish;  // from here on there is a best so far
  TWIN_CHECK(search_in_stages(cost, {name, checkpoint, options}, x, fit));
  fit.cost_after = fit.was_stopped ? fit.cost_after : cost(x, kNear, kAllCores);
  if (fit.cost_after > fit.cost_before) {  // the wide stage has left what was better
    x = parameters.units(planned);
    fit.cost_after = fit.cost_before;
  }
  fit.machine = parameters.with_units(planned, x);
  fit.time_error = time_error(rows, runs);
  const std::vector<double> before = parameters.values(start);
  const std::vector<double> after = parameters.values(fit.machine);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    FittedValue value{parameters[i].key, before[i], after[i], 0.0, false};
    value.is_at_bound = x[i] < 1e-3 || x[i] > 1.0 - 1e-3;
    if (!fit.was_stopped) {
      std::vector<double> moved = x;
      moved[i] = std::max(x[i] - kMoved, 0.0);
      const double less = cost(moved, kNear, kAllCores);
      moved[i] = std::min(x[i] + kMoved, 1.0);
      value.rise = std::min(less, cost(moved, kNear, kAllCores)) - fit.cost_after;
    }
    fit.values.push_back(std::move(value));
  }
  return fit;
}

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
