#include "studies/identify/torque_servo.hpp"

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "studies/identify/judge.hpp"
#include "studies/identify/least_squares.hpp"

namespace twin::studies::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMuchBetter = 0.7;      // of the rest, that feedforward must leave at most
constexpr double kBlockTime = 0.25;      // within which the rest may be correlated [s]
constexpr double kLagDoubt = 0.02;       // of the lag
constexpr double kLagRest = 0.02;        // of the peak velocity, below which it rests
constexpr double kPoorTorqueLaw = 0.02;  // of the drive command, from which on a rest is a poor fit

/// A linear fit of volts: e, w, trim and perhaps v, a.
struct LawFit {
  int periods = 1;
  VectorXd values;
  VectorXd sigma;
  double rest = 0.0;  // RMS over the RMS of the drive command
  bool has_feedforward() const { return values.size() > 3; }
};

LawFit fit_law(std::span<const AxisRecord> records, double period, int periods,
               bool has_feedforward) {
  std::vector<double> volts;
  std::vector<std::array<double, 5>> rows;
  for (const AxisRecord& record : records) {
    for (auto k = static_cast<std::size_t>(motion::kMostVelocityPeriods); k < record.volts.size();
         ++k) {
      const auto ago = static_cast<std::size_t>(periods);
      if (std::abs(record.volts[k]) > 0.999 * motion::kMaxVolts || !record.counts(k)) {
        continue;
      }
      const motion::Reference& r = record.command[k];
      rows.push_back({r.position - record.measured[k],
                      (record.measured[k - ago] - record.measured[k]) / (periods * period), 1.0,
                      r.velocity, r.acceleration});
      volts.push_back(record.volts[k]);
    }
  }
  const auto n = static_cast<Index>(rows.size());
  MatrixXd w(n, has_feedforward ? 5 : 3);
  for (Index k = 0; k < n; ++k) {
    for (Index i = 0; i < w.cols(); ++i) {
      w(k, i) = rows[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
    }
  }
  const VectorXd right = Eigen::Map<const VectorXd>(volts.data(), n);
  LawFit fit;
  fit.periods = periods;
  fit.values = transposed_product(normal_inverse(w), transposed_product(w, right));
  const VectorXd rest = right - w.lazyProduct(fit.values);
  fit.sigma = block_covariance(w, rest, static_cast<Index>(std::lround(kBlockTime / period)))
                  .diagonal()
                  .cwiseSqrt();
  fit.rest = rest.norm() / std::max(right.norm(), 1e-300);
  return fit;
}

LawFit best_law(std::span<const AxisRecord> records, double period) {
  LawFit best = fit_law(records, period, 1, false);
  for (int periods = 2; periods <= motion::kMostVelocityPeriods; ++periods) {
    LawFit fit = fit_law(records, period, periods, false);
    best = fit.rest < best.rest ? std::move(fit) : std::move(best);
  }
  LawFit more = fit_law(records, period, best.periods, true);
  return more.rest < kMuchBetter * best.rest ? more : best;
}

FittedParameter gain(std::string key, std::string name, double start, double value, double sigma,
                     const LawFit& law) {
  FittedParameter parameter;
  parameter.key = std::move(key);
  parameter.name = std::move(name);
  parameter.start = start;
  parameter.value = value;
  parameter.sigma = sigma;
  parameter.relative = sigma / std::max(std::abs(value), 1e-9);
  parameter.verdict = Verdict::kMeasured;
  if (law.rest > kPoorTorqueLaw) {
    parameter.verdict = Verdict::kUncertain;
    parameter.why = "the drive commands follow another law than Kp, Kv, Kf, Ka";
  }
  return parameter;
}

}  // namespace

std::vector<FittedParameter> measure_torque_servo(const AxisProblem& problem,
                                                  const FitOptions& options,
                                                  config::MachineFile& machine) {
  const LawFit law = best_law(problem.all_records(), machine.period);
  const std::string axis = problem.axis() == hal::kX ? "x" : "y";
  const std::string servo = "servo." + axis + ".";
  const std::string scale_key = "table." + axis + ".vref_scale_rpm_per_V";
  hal::mujoco::AxisParams& params = machine.table.axis[problem.axis()];
  motion::Gains& gains = machine.servo[problem.axis()];
  const motion::Gains before = gains;
  std::vector<FittedParameter> found;
  const double start_scale = params.drive.vref_scale_rpm_per_V;
  if (!options.is_fixed(scale_key) && law.values[1] > 0.0) {
    params.drive.vref_scale_rpm_per_V = 60.0 / (law.values[1] * params.screw.lead);
    found.push_back(gain(scale_key, "V-REF scale", start_scale, params.drive.vref_scale_rpm_per_V,
                         params.drive.vref_scale_rpm_per_V * law.sigma[1] / law.values[1], law));
  }
  const double s = params.mm_per_s_per_volt();
  gains = {.kp = law.values[0] * s,
           .kd = 0.0,
           .kf = law.has_feedforward() ? law.values[3] * s : 0.0,
           .ka = law.has_feedforward() ? law.values[4] * s : 0.0,
           .trim_V = law.values[2],
           .kv = law.values[1] * s,
           .kv_periods = law.periods,
           .command_delay = 0.0};
  found.push_back(gain(servo + "kp_per_s", "position gain Kp", before.kp, gains.kp,
                       law.sigma[0] * std::abs(s), law));
  found.push_back(gain(servo + "kv", "velocity feedback Kv", before.kv, gains.kv,
                       law.sigma[1] * std::abs(s), law));
  if (law.has_feedforward()) {
    found.push_back(gain(servo + "kf", "velocity feedforward Kf", before.kf, gains.kf,
                         law.sigma[3] * std::abs(s), law));
    found.push_back(gain(servo + "ka_s", "acceleration feedforward Ka", before.ka, gains.ka,
                         law.sigma[4] * std::abs(s), law));
  }
  found.push_back(gain(servo + "trim_V", "trim", before.trim_V, gains.trim_V, law.sigma[2], law));
  return found;
}

FittedParameter measure_velocity_lag(const AxisProblem& problem) {
  const double period = problem.base().period;
  double peak = 0.0;
  for (const AxisRecord& record : problem.all_records()) {
    for (const motion::Reference& r : record.command) {
      peak = std::max(peak, std::abs(r.velocity));
    }
  }
  std::vector<std::array<double, 5>> rows;
  for (const AxisRecord& record : problem.all_records()) {
    for (std::size_t k = 2; k + 2 < record.command.size(); ++k) {
      const motion::Reference& r = record.command[k];
      if (std::abs(r.velocity) > kLagRest * peak && record.counts(k)) {
        rows.push_back({r.velocity, r.acceleration, std::copysign(1.0, r.velocity), 1.0,
                        r.position - record.measured[k]});
      }
    }
  }
  const auto n = static_cast<Index>(rows.size());
  MatrixXd w(n, 4);
  VectorXd error(n);
  for (Index k = 0; k < n; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k)];
    for (Index i = 0; i < 4; ++i) {
      w(k, i) = row[static_cast<std::size_t>(i)];
    }
    error[k] = row[4];
  }
  FittedParameter lag;
  lag.name = "velocity lag (1 - Kf) / Kp";
  if (n < 100) {
    lag.verdict = Verdict::kUnidentified;
    return lag;
  }
  const VectorXd fit = transposed_product(normal_inverse(w), transposed_product(w, error));
  const MatrixXd covariance = block_covariance(
      w, error - w.lazyProduct(fit), static_cast<Index>(std::lround(kBlockTime / period)));
  lag.value = fit[0] * 1e3;
  lag.sigma = std::hypot(std::sqrt(covariance(0, 0)), kLagDoubt * fit[0]) * 1e3;
  lag.relative = lag.sigma / std::max(std::abs(lag.value), 0.05);
  lag.verdict = lag.relative > kMostRelative ? Verdict::kUncertain : Verdict::kIdentified;
  return lag;
}

}  // namespace twin::studies::identify
