#include "studies/identify/measured_parameters.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/linear_algebra.hpp"
#include "motion/servo/axis_servo.hpp"
#include "studies/identify/judge.hpp"

namespace twin::studies::identify {
namespace {

/// A gain of the servo, with the size from which on it has an effect.
struct Gain {
  const char* key;
  const char* name;
  double motion::Gains::*field;
  double natural;
};

constexpr std::array<Gain, 5> kGains{
    {{"kp_per_s", "position gain Kp", &motion::Gains::kp, 1.0},
     {"kd", "derivative gain Kd", &motion::Gains::kd, 0.02},
     {"kf", "velocity feedforward Kf", &motion::Gains::kf, 0.05},
     {"ka_s", "acceleration feedforward Ka", &motion::Gains::ka, 4e-4},
     {"trim_V", "trim", &motion::Gains::trim_V, 4e-3}}};

constexpr int kUnknowns = 5;      // the gains of a servo
constexpr double kRidge = 1e-14;  // what a gain that nothing shows is held to 0 by

using Row = Eigen::Matrix<double, kUnknowns, 1>;

constexpr double kPoorLaw = 0.01;    // of the drive command, that the law may leave
constexpr double kFineVolts = 2e-3;  // which a converter's rounding may leave besides [V]

double rms_volts(std::span<const AxisRecord> records) {
  double sum = 0.0;
  double rows = 0.0;
  for (const AxisRecord& record : records) {
    for (const double volts : record.volts) {
      sum += volts * volts;
      rows += 1.0;
    }
  }
  return std::sqrt(sum / std::max(rows, 1.0));
}

}  // namespace

FittedParameter measure_count(const AxisProblem& problem, const FitOptions& options,
                              config::MachineFile& machine) {
  hal::mujoco::EncoderParams& encoder = machine.table.axis[problem.axis()].encoder;
  FittedParameter parameter;
  parameter.key = table_section(problem.axis()) + "encoder_um_per_count";
  parameter.name = "encoder count";
  parameter.start = parameter.value = encoder.mm_per_count * 1e3;
  if (options.is_fixed(parameter.key)) {
    parameter.verdict = Verdict::kFixed;
    return parameter;
  }
  const auto quantum = quantum_of(problem.records().front().measured);
  if (!quantum) {
    // Another machine's count would round every prediction by what this one does not.
    if (const auto step = smallest_step(problem.records().front().measured)) {
      encoder.mm_per_count = std::copysign(*step, encoder.mm_per_count);
      parameter.value = encoder.mm_per_count * 1e3;
    }
    parameter.verdict = Verdict::kUncertain;
    parameter.why =
        "the measured values are not whole multiples of anything; this is the smallest "
        "step among them";
    return parameter;
  }
  encoder.mm_per_count = std::copysign(*quantum, encoder.mm_per_count);
  parameter.value = encoder.mm_per_count * 1e3;
  parameter.verdict = Verdict::kMeasured;
  return parameter;
}

std::vector<FittedParameter> measure_gains(const AxisProblem& problem, const FitOptions& options,
                                           config::MachineFile& machine) {
  std::vector<FittedParameter> parameters;
  if (!problem.has_volts()) {
    return parameters;
  }
  const hal::mujoco::AxisParams& axis = machine.table.axis[problem.axis()];
  GainFit fit = fit_gains(problem.records(), axis.mm_per_s_per_volt(), machine.period);
  motion::Gains& servo = machine.servo[problem.axis()];
  const bool is_law = fit.rms_V <= kPoorLaw * rms_volts(problem.records()) + kFineVolts;
  const std::string section = problem.axis() == hal::kX ? "servo.x." : "servo.y.";
  for (const Gain& gain : kGains) {
    FittedParameter& parameter = parameters.emplace_back();
    parameter.key = section + gain.key;
    parameter.name = gain.name;
    parameter.start = parameter.value = servo.*gain.field;
    parameter.sigma = fit.sigma.*gain.field;
    parameter.relative = parameter.sigma / std::max(std::abs(fit.gains.*gain.field), gain.natural);
    if (options.is_fixed(parameter.key)) {
      parameter.verdict = Verdict::kFixed;
      parameter.sigma = 0.0;
    } else if (parameter.relative < kMostRelative) {
      parameter.verdict = is_law ? Verdict::kMeasured : Verdict::kUncertain;
      servo.*gain.field = parameter.value = fit.gains.*gain.field;
      if (!is_law) {
        parameter.why = "the drive commands follow another law than Kp, Kd, Kf, Ka";
      } else if (parameter.value < 0.0 && gain.field == &motion::Gains::kp) {
        parameter.verdict = Verdict::kUncertain;
        parameter.why = "is below 0, which makes a loop unstable: is it a drive in torque mode?";
        servo.*gain.field = parameter.value = 0.0;
      }
    } else {
      parameter.verdict = Verdict::kUnidentified;
      parameter.why = "the drive commands do not show it";
    }
  }
  return parameters;
}

GainFit fit_gains(std::span<const AxisRecord> records, double mm_per_s_per_volt, double period) {
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  Row right = Row::Zero();
  double square = 0.0;
  double rows = 0.0;
  for (const AxisRecord& record : records) {
    for (std::size_t k = 1; k < record.volts.size(); ++k) {
      if (std::abs(record.volts[k]) > 0.999 * motion::kMaxVolts || !record.counts(k) ||
          !record.counts(k - 1)) {
        continue;
      }
      const motion::Reference& reference = record.command[k];
      const double error = reference.position - record.measured[k];
      const double last = record.command[k - 1].position - record.measured[k - 1];
      Row row;
      row << error, (error - last) / period, reference.velocity, reference.acceleration,
          mm_per_s_per_volt;
      const double wanted = record.volts[k] * mm_per_s_per_volt;
      normal += row * row.transpose();
      right += row * wanted;
      square += wanted * wanted;
      rows += 1.0;
    }
  }
  normal.diagonal() *= 1.0 + kRidge;
  const Row gains = solve_symmetric(normal, right);
  const double left = std::max(square - right.dot(gains), 0.0) / std::max(rows - kUnknowns, 1.0);
  const Row sigma = (normal.inverse().diagonal() * left).cwiseSqrt();
  const auto as_gains = [](const Row& row) {
    return motion::Gains{.kp = row[0], .kd = row[1], .kf = row[2], .ka = row[3], .trim_V = row[4]};
  };
  return {as_gains(gains), as_gains(sigma), std::sqrt(left) / std::abs(mm_per_s_per_volt)};
}

}  // namespace twin::studies::identify
