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

constexpr double kNoStep = 1e-10;        // rounding of a number in a file
constexpr double kWholeTolerance = 0.1;  // how far from whole a multiple may be
constexpr double kWholeShare = 0.98;     // of the steps that must be whole multiples
constexpr std::size_t kFewestSteps = 20;
constexpr double kMostMultiple = 50.0;  // larger steps say nothing of the quantum

/// Refines a guess over all steps that are small multiples of it; nothing if few steps are.
std::optional<double> refined(const std::vector<double>& sorted_steps, double guess) {
  double quantum = guess;
  std::size_t whole = 0;
  std::size_t tried = 0;
  for (const double step : sorted_steps) {
    // The more steps agree, the larger multiples can be told from their neighbours.
    const double multiple = step / quantum;
    if (multiple > kMostMultiple) {
      break;
    }
    ++tried;
    const double nearest = std::round(multiple);
    if (nearest >= 1.0 && std::abs(multiple - nearest) < kWholeTolerance) {
      ++whole;
      quantum += (step / nearest - quantum) / static_cast<double>(whole);
    }
  }
  const bool is_whole = static_cast<double>(whole) >= kWholeShare * static_cast<double>(tried);
  return tried >= kFewestSteps && is_whole ? std::optional(quantum) : std::nullopt;
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
    parameter.verdict = Verdict::kUnidentified;
    parameter.why = "the measured values are not whole multiples of anything";
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
  fit.gains.kp = std::max(fit.gains.kp, 0.0);
  fit.gains.kd = std::max(fit.gains.kd, 0.0);
  fit.gains.kf = std::max(fit.gains.kf, 0.0);
  motion::Gains& servo = machine.servo[problem.axis()];
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
      parameter.verdict = Verdict::kMeasured;
      servo.*gain.field = parameter.value = fit.gains.*gain.field;
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
      if (std::abs(record.volts[k]) > 0.999 * motion::kMaxVolts) {
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
  return {{gains[0], gains[1], gains[2], gains[3], gains[4]},
          {sigma[0], sigma[1], sigma[2], sigma[3], sigma[4]},
          std::sqrt(left) / std::abs(mm_per_s_per_volt)};
}

std::optional<double> quantum_of(std::span<const double> values) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step = std::abs(values[k] - values[k - 1]);
    if (step > kNoStep) {
      steps.push_back(step);
    }
  }
  if (steps.size() < kFewestSteps) {
    return std::nullopt;
  }
  std::ranges::sort(steps);
  // The very smallest may be a stray; a fast motion has few that are small.
  for (const std::size_t place : {std::size_t{0}, steps.size() / 1000, steps.size() / 200}) {
    if (const auto quantum = refined(steps, steps[place])) {
      return quantum;
    }
  }
  return std::nullopt;
}

}  // namespace twin::studies::identify
