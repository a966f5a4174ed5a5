#include <algorithm>
#include <vector>

#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/direct.hpp"

// The parts of a fit that are about the hum on V-REF.
namespace twin::studies::identify {
namespace {

constexpr double kTellingHum = 1.1;  // of the residual, that there is without a hum to speak of
constexpr double kHumRange = 0.5;    // of 1 / duration, about the frequency found

bool is_of_hum(const std::string& key) { return key.find(".hum_") != std::string::npos; }

}  // namespace

/// Frequency and phase of a hum that is not there mean nothing.
void AxisFitter::doubt_hum_without_amplitude() {
  const auto is_unknown = [](const Searched& p) {
    return p.result.key.ends_with("hum_amplitude_mV") && p.result.verdict == Verdict::kUnidentified;
  };
  if (std::ranges::none_of(searched_, is_unknown)) {
    return;
  }
  for (Searched& p : searched_) {
    if (is_of_hum(p.result.key) && p.result.verdict == Verdict::kIdentified) {
      p.result.verdict = Verdict::kUnidentified;
      p.result.why = "there is no hum to speak of";
    }
  }
}

void AxisFitter::estimate_hum() {
  std::vector<Searched*> hum;  // amplitude, frequency, phase
  for (Searched& parameter : searched_) {
    if (is_of_hum(parameter.result.key)) {
      if (parameter.is_held) {
        return;  // the user knows it
      }
      hum.push_back(&parameter);
    }
  }
  hal::mujoco::DriveParams& drive = current_.table.axis[problem_.axis()].drive;
  if (direct_hum(problem_, current_) == Hum::kFound) {
    Parameter& frequency = hum[1]->candidate.parameter;
    const double range =
        kHumRange /
        (static_cast<double>(problem_.records().front().measured.size()) * current_.period);
    frequency.min = drive.hum_frequency_Hz - range;
    frequency.max = drive.hum_frequency_Hz + range;
    return;
  }
  for (Searched* const parameter : hum) {
    hold(*parameter, Verdict::kUnidentified, 0.0, 0.0, "no tone stands out");
  }
  drive.hum_amplitude = 0.0;
  hum[0]->result.verdict = Verdict::kMeasured;
  hum[0]->result.value = 0.0;
}

/// Drops a hum that changes little of a residual which is a lack of fit: the ringing of a structure
/// makes a tone, too, but none that goes on at rest.
void AxisFitter::drop_doubtful_hum() {
  const double rms = rms_of(current_);
  config::MachineFile without = current_;
  without.table.axis[problem_.axis()].drive.hum_amplitude = 0.0;
  if (rms <= kLackOfFit * fit_.rounding_rms || !is_free("hum_amplitude_mV") ||
      rms_of(without) > kTellingHum * rms) {
    return;
  }
  for (Searched& parameter : searched_) {
    if (is_of_hum(parameter.result.key) && !parameter.is_held) {
      hold(parameter, Verdict::kUnidentified, 0.0, 0.0,
           "the residual is hardly smaller with a hum");
    }
  }
  current_.table.axis[problem_.axis()].drive.hum_amplitude = 0.0;
  polish(20);
}

}  // namespace twin::studies::identify
