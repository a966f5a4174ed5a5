#include <algorithm>
#include <cmath>

#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/direct.hpp"
#include "studies/identify/gain_fit.hpp"
#include "studies/identify/quantum.hpp"

// What an AxisFitter reads off the records before it searches.
namespace twin::studies::identify {
namespace {

constexpr double kHumRange = 0.5;  // of 1 / duration, about the frequency found

}  // namespace

void AxisFitter::estimate_quantum() {
  hal::mujoco::EncoderParams& encoder = current_.table.axis[problem_.axis()].encoder;
  const std::string key = table_section(problem_.axis()) + "encoder_um_per_count";
  FittedParameter& parameter = result(key, "encoder count");
  parameter.start = parameter.value = encoder.mm_per_count * 1e3;
  if (is_fixed(key)) {
    parameter.verdict = Verdict::kFixed;
    return;
  }
  const auto quantum = quantum_of(problem_.records().front().measured);
  if (!quantum) {
    parameter.verdict = Verdict::kUnidentified;
    parameter.why = "the measured values are not whole multiples of anything";
    return;
  }
  encoder.mm_per_count = std::copysign(*quantum, encoder.mm_per_count);
  parameter.value = encoder.mm_per_count * 1e3;
  parameter.verdict = Verdict::kMeasured;
  fit_.rounding_rms = *quantum / std::sqrt(12.0);
}

void AxisFitter::estimate_gains() {
  if (!has_volts()) {
    return;
  }
  const hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
  GainFit gains = fit_gains(problem_.records(), axis.mm_per_s_per_volt(), current_.period);
  gains.gains.kp = std::max(gains.gains.kp, 0.0);
  gains.gains.kd = std::max(gains.gains.kd, 0.0);
  gains.gains.kf = std::max(gains.gains.kf, 0.0);
  motion::Gains& servo = current_.servo[problem_.axis()];
  const std::string section = problem_.axis() == hal::kX ? "servo.x." : "servo.y.";
  struct Line {
    const char* key;
    const char* name;
    double motion::Gains::*field;
    double natural;
  };
  for (const Line& line : {Line{"kp_per_s", "position gain Kp", &motion::Gains::kp, 1.0},
                           Line{"kd", "derivative gain Kd", &motion::Gains::kd, 0.02},
                           Line{"kf", "velocity feedforward Kf", &motion::Gains::kf, 0.05},
                           Line{"ka_s", "acceleration feedforward Ka", &motion::Gains::ka, 4e-4},
                           Line{"trim_V", "trim", &motion::Gains::trim_V, 4e-3}}) {
    FittedParameter& parameter = result(section + line.key, line.name);
    parameter.start = parameter.value = servo.*line.field;
    parameter.sigma = gains.sigma.*line.field;
    parameter.relative =
        parameter.sigma / std::max(std::abs(gains.gains.*line.field), line.natural);
    if (is_fixed(parameter.key)) {
      parameter.verdict = Verdict::kFixed;
      parameter.sigma = 0.0;
    } else if (parameter.relative < kMostRelative) {
      parameter.verdict = Verdict::kMeasured;
      servo.*line.field = parameter.value = gains.gains.*line.field;
    } else {
      parameter.verdict = Verdict::kUnidentified;
      parameter.why = "the drive commands do not show it";
    }
  }
}

void AxisFitter::estimate_hum() {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].parameter.key.find(".hum_") != std::string::npos) {
      if (is_held_[i]) {
        return;  // the user knows it
      }
      places.push_back(i);
    }
  }
  if (direct_hum(problem_, current_)) {
    Parameter& frequency = candidates_[places[1]].parameter;
    const double found = current_.table.axis[problem_.axis()].drive.hum_frequency_Hz;
    const double range =
        kHumRange /
        (static_cast<double>(problem_.records().front().measured.size()) * current_.period);
    frequency.min = found - range;
    frequency.max = found + range;
    return;
  }
  for (const std::size_t place : places) {
    hold(place, Verdict::kUnidentified, 0.0, 0.0, "no tone stands out");
  }
  current_.table.axis[problem_.axis()].drive.hum_amplitude = 0.0;
  results_[places[0]].verdict = Verdict::kMeasured;
  results_[places[0]].value = 0.0;
}

void AxisFitter::estimate_directly() {
  estimate_quantum();
  hal::mujoco::DriveParams& drive = current_.table.axis[problem_.axis()].drive;
  const auto is_free = [&](const std::string& name) {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].parameter.key.ends_with(name)) {
        return !is_held_[i];
      }
    }
    return false;
  };
  if (const auto scale = direct_scale(problem_); scale && is_free("vref_scale_rpm_per_V")) {
    drive.vref_scale_rpm_per_V = *scale;
  }
  estimate_gains();
  estimate_hum();
  if (is_free("vref_offset_mV")) {
    drive.vref_offset += direct_offset(problem_, current_);
  }
}

}  // namespace twin::studies::identify
