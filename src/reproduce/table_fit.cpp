#include "reproduce/table_fit.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "config/find_file.hpp"
#include "config/overrides.hpp"
#include "core/units.hpp"
#include "identify/minimise.hpp"
#include "identify/parallel_for.hpp"
#include "identify/table_run.hpp"
#include "reproduce/figure_kinds.hpp"
#include "reproduce/phases.hpp"
#include "reproduce/table_parameters.hpp"

namespace twin::reproduce {
namespace {

using config::MachineFile;
using identify::RunErrors;
using identify::TableRun;

constexpr double kLargestKf = 0.6;  // of the planning model, that is tried
constexpr int kBitsOfKf = 12;       // a few thousandths
constexpr std::size_t kErrors = 6;  // of a row: all figures but the time, which comes last
constexpr double kMoved = 0.1;      // of a range, to see whether a parameter matters

/// The measured rows with their programs and the settings they are run with.
class Rows {
 public:
  static Expected<Rows> create(const Published& published) {
    Rows rows;
    for (const PublishedRow& row : published.rows) {
      if (!is_measured(row.table)) {
        continue;
      }
      auto program = config::find_program(row.program + ".nc");
      if (!program) {
        return tl::unexpected(program.error());
      }
      rows.rows_.push_back({row, *program});
    }
    return rows;
  }

  /// Plans every row with the planning keys of a machine file.
  Expected<std::vector<TableRun>> plan(const MachineFile& machine) const {
    std::vector<Expected<TableRun>> planned(rows_.size());
    identify::parallel_for(rows_.size(), [&](std::size_t i) {
      MachineFile file = machine;
      std::vector<std::string> settings = rows_[i].row.settings;
      settings.push_back("interpolator.kind=" + rows_[i].row.interpolator);
      if (auto set = config::apply_overrides(file, settings); !set) {
        planned[i] = tl::unexpected(set.error());
        return;
      }
      planned[i] =
          TableRun::plan(rows_[i].program, file,
                         units::mm_per_s_from_mm_per_min(rows_[i].row.feedrate_mm_per_min));
    });
    std::vector<TableRun> runs;
    for (auto& run : planned) {
      if (!run) {
        return tl::unexpected(run.error());
      }
      runs.push_back(std::move(*run));
    }
    return runs;
  }

  std::size_t size() const { return rows_.size(); }
  /// Published figures of a row, in the order of columns_of().
  const std::vector<double>& figures(std::size_t i) const { return rows_[i].row.figures; }

 private:
  struct Row {
    PublishedRow row;
    std::filesystem::path program;
  };
  std::vector<Row> rows_;
};

std::array<double, kErrors> figures_um(const RunErrors& e) {
  std::array<double, kErrors> figures{e.contour_max, e.contour_rms, e.axis_max[0],
                                      e.axis_rms[0], e.axis_max[1], e.axis_rms[1]};
  std::ranges::for_each(figures, [](double& x) { x = units::um_from_mm(x); });
  return figures;
}

/// Root mean square of machining time / published - 1.
double time_error(const Rows& rows, const std::vector<TableRun>& runs) {
  double sum = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    sum += std::pow(runs[i].machining_time() / rows.figures(i).back() - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(runs.size()));
}

double cost_of(const Rows& rows, const std::vector<TableRun>& runs, const MachineFile& machine,
               int repeats) {
  const auto n = static_cast<std::size_t>(repeats);
  std::vector<std::array<double, kErrors>> figures(runs.size() * n);
  identify::parallel_for(figures.size(), [&](std::size_t i) {
    MachineFile file = machine;
    file.table = with_phases_of_repeat(machine.table, static_cast<int>(i % n));
    figures[i] = figures_um(runs[i / n].run(file));
  });
  double cost = 0.0;
  for (std::size_t row = 0; row < runs.size(); ++row) {
    for (std::size_t k = 0; k < kErrors; ++k) {
      double mean = 0.0;
      for (std::size_t repeat = 0; repeat < n; ++repeat) {
        mean += figures[row * n + repeat][k] / static_cast<double>(n);
      }
      cost += figure_cost(mean, rows.figures(row)[k]);
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

}  // namespace

double figure_cost(double ours, double published) {
  const double e2 = std::pow(std::log(ours / published), 2);
  if (!std::isfinite(e2)) {
    return std::numeric_limits<double>::infinity();
  }
  return 0.5 * e2 / (e2 + 0.15 * 0.15) + 0.5 * e2 / (e2 + 0.28 * 0.28) + 0.05 * e2;
}

Expected<TableFit> fit_tables(const Published& published, const MachineFile& start,
                              const TableFitOptions& options) {
  auto rows = Rows::create(published);
  auto parameters = identify::ParameterSet::create(table_parameters());
  if (!rows || !parameters) {
    return tl::unexpected(!rows ? rows.error() : parameters.error());
  }
  const auto planned = fit_planning(*rows, start);
  if (!planned) {
    return tl::unexpected(planned.error());
  }
  const auto runs = rows->plan(*planned);
  if (!runs) {
    return tl::unexpected(runs.error());
  }
  const auto cost = [&](std::span<const double> x) {
    return cost_of(*rows, *runs, parameters->with_units(*planned, x), options.repeats);
  };
  identify::MinimiseOptions search;
  search.start = parameters->units(*planned);
  search.spread = options.spread;
  search.evaluations = options.evaluations;
  search.seed = options.seed;
  search.stop = options.stop;
  search.progress = options.progress;

  TableFit fit;
  fit.cost_before = cost_of(*rows, *runs, *planned, options.repeats);
  const identify::Minimum best = identify::minimise(cost, search);
  fit.machine = parameters->with_units(*planned, best.x);
  fit.cost_after = best.cost;
  fit.time_error = time_error(*rows, *runs);
  fit.was_stopped = best.was_stopped;
  const std::vector<double> before = parameters->values(start);
  const std::vector<double> after = parameters->values(fit.machine);
  for (std::size_t i = 0; i < parameters->size(); ++i) {
    FittedValue value{(*parameters)[i].key, before[i], after[i], 0.0, false};
    value.is_at_bound = best.x[i] < 1e-3 || best.x[i] > 1.0 - 1e-3;
    if (!best.was_stopped) {
      std::vector<double> moved = best.x;
      moved[i] = std::max(best.x[i] - kMoved, 0.0);
      const double less = cost(moved);
      moved[i] = std::min(best.x[i] + kMoved, 1.0);
      value.rise = std::min(less, cost(moved)) - best.cost;
    }
    fit.values.push_back(std::move(value));
  }
  return fit;
}

}  // namespace twin::reproduce
