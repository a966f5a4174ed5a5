#include "studies/identify/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "config/binding.hpp"
#include "core/units.hpp"

namespace twin::studies::identify {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWhyWidth = 110;

bool is_found(const FittedParameter& parameter) {
  return parameter.verdict == Verdict::kIdentified || parameter.verdict == Verdict::kMeasured;
}

/// Digits so that the uncertainty shows with two of them.
std::string rounded(double value, double sigma) {
  if (!(sigma > 0.0) || !std::isfinite(sigma)) {
    return fmt::format("{:.6g}", value);
  }
  const int digits = static_cast<int>(std::ceil(1.0 - std::log10(sigma)));
  return fmt::format("{:.{}f}", value, std::clamp(digits, 0, 6));
}

/// Unit of a key as people write it; empty for a plain number.
std::string unit_of(const std::string& key) {
  config::MachineFile machine;
  for (const config::Binding& binding : config::bindings(machine)) {
    if (binding.path() == key) {
      return config::pretty_unit(binding.unit);
    }
  }
  return {};
}

std::string relative_text(const FittedParameter& p) {
  if (p.verdict == Verdict::kFixed || !(p.sigma > 0.0)) {
    return "";
  }
  if (p.relative < 1e-4) {
    return "< 0.01 %";
  }
  return p.relative > 9.99 ? "> 999 %" : fmt::format("{:.2g} %", 100.0 * p.relative);
}

std::string parameter_line(const FittedParameter& p) {
  const std::string value = rounded(p.value, is_found(p) ? p.sigma : 0.0);
  const std::string sigma =
      is_found(p) && p.sigma > 0.0 ? "+- " + rounded(p.sigma, p.sigma) : std::string();
  std::string why = p.why.substr(0, kWhyWidth);
  why += why.size() < p.why.size() ? ".." : "";
  std::string line = fmt::format("    {:<28} {:>10} {:<13} {:<9} {:>8}  {}{}{}", p.name, value,
                                 sigma, unit_of(p.key), is_found(p) ? relative_text(p) : "",
                                 verdict_name(p.verdict), why.empty() ? "" : ": ", why);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string axis_table(const AxisFit& fit, hal::Axis axis) {
  std::string text = fmt::format("\n  {} axis\n    {:<28} {:>10} {:<13} {:<9} {:>8}  {}\n",
                                 axis == hal::kX ? "X" : "Y", "", "value", "1 sigma", "unit",
                                 "relative", "the data");
  for (const FittedParameter& parameter : fit.parameters) {
    text += parameter_line(parameter);
  }
  text += fmt::format("    residual {:.3g} um RMS", units::um_from_mm(fit.residual_rms));
  if (fit.rounding_rms > 0.0) {
    text += fmt::format("; rounding to counts alone makes {:.3g} um",
                        units::um_from_mm(fit.rounding_rms));
  }
  return text + "\n";
}

/// Where a value comes from, for the machine file.
std::string comment(const FittedParameter& p) {
  switch (p.verdict) {
    case Verdict::kIdentified:
      return fmt::format("identified, 1 sigma {} ({})", rounded(p.sigma, p.sigma),
                         relative_text(p));
    case Verdict::kMeasured:
      return "read off the trace";
    case Verdict::kUnidentified:
      return "not identified, starting value: " + p.why;
    case Verdict::kAtBound:
      return "not identified, starting value: " + p.why;
    case Verdict::kFixed:
      return "fixed";
  }
  return {};
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json axis_json(const AxisFit& fit) {
  Json parameters = Json::array();
  for (const FittedParameter& p : fit.parameters) {
    Json entry{{"key", p.key},
               {"name", p.name},
               {"start", number(p.start)},
               {"value", number(p.value)},
               {"sigma", number(p.sigma)},
               {"relative_sigma", number(p.relative)},
               {"identified", is_found(p)},
               {"verdict", verdict_name(p.verdict)}};
    if (!p.why.empty()) {
      entry["why"] = p.why;
    }
    parameters.push_back(std::move(entry));
  }
  return {{"residual_rms_um", units::um_from_mm(fit.residual_rms)},
          {"rounding_rms_um", units::um_from_mm(fit.rounding_rms)},
          {"search_evaluations", fit.evaluations},
          {"parameters", std::move(parameters)}};
}

Json figures_json(const ErrorFigures& figures) {
  return {{"rms", units::um_from_mm(figures.rms)}, {"max", units::um_from_mm(figures.max)}};
}

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentified:
      return "identified";
    case Verdict::kMeasured:
      return "measured";
    case Verdict::kUnidentified:
      return "not identified";
    case Verdict::kAtBound:
      return "not identified";
    case Verdict::kFixed:
      return "fixed";
  }
  return "";
}

std::string to_table(const Identification& result) {
  std::string text;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (result.axis[axis]) {
      text += axis_table(*result.axis[axis], axis);
    } else {
      text += fmt::format("\n  {} axis: did not move or was not recorded; not identified\n",
                          axis == hal::kX ? "X" : "Y");
    }
  }
  text += fmt::format(
      "\n  tracking error um              measured RMS / max    of the identified machine\n");
  for (const Prediction& p : result.predictions) {
    text += fmt::format("    {} {:<26} {:>9.3f} / {:<9.3f} {:>9.3f} / {:<9.3f} ({:+.1f} % RMS)\n",
                        p.axis == hal::kX ? "X" : "Y",
                        std::filesystem::path(p.trace).filename().string(),
                        units::um_from_mm(p.measured.rms), units::um_from_mm(p.measured.max),
                        units::um_from_mm(p.simulated.rms), units::um_from_mm(p.simulated.max),
                        100.0 * (p.simulated.rms / p.measured.rms - 1.0));
  }
  return text;
}

std::string to_json(const Identification& result, const std::filesystem::path& machine_file) {
  Json json;
  json["machine_file"] = machine_file.string();
  json["period_s"] = result.machine.period;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    json["axis"][axis == hal::kX ? "x" : "y"] =
        result.axis[axis] ? axis_json(*result.axis[axis]) : Json(nullptr);
  }
  json["predictions"] = Json::array();
  for (const Prediction& p : result.predictions) {
    json["predictions"].push_back({{"trace", p.trace},
                                   {"axis", p.axis == hal::kX ? "x" : "y"},
                                   {"measured_tracking_error_um", figures_json(p.measured)},
                                   {"simulated_tracking_error_um", figures_json(p.simulated)}});
  }
  json["notes"] = result.notes;
  return json.dump(2) + "\n";
}

std::string to_machine_file(const Identification& result) {
  std::map<std::string, std::string> comments;
  for (const auto& fit : result.axis) {
    if (fit) {
      for (const FittedParameter& parameter : fit->parameters) {
        comments[parameter.key] = comment(parameter);
      }
    }
  }
  std::string text =
      "# Machine file written by twin identify; its comments say what was found.\n\n";
  return text + config::to_toml(result.machine, [&comments](const std::string& path) {
           const auto found = comments.find(path);
           return found == comments.end() ? std::string() : found->second;
         });
}

}  // namespace twin::studies::identify
