#include "studies/identify/measured_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/identify/gain_fit.hpp"
#include "studies/identify/judge.hpp"
#include "studies/identify/quantum.hpp"

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

}  // namespace twin::studies::identify
