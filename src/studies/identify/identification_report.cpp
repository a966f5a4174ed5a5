#include "studies/identify/identification_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "config/binding.hpp"
#include "core/json.hpp"
#include "core/text_table.hpp"
#include "core/units.hpp"
#include "studies/identify/validation_report.hpp"

namespace twin::studies::identify {
namespace {

constexpr std::size_t kReasonWidth = 76;  // of a line of a reason
constexpr double kSameValue = 1e-6;       // relative
constexpr TextLayout kParameters{.notes = Notes::kShown};
constexpr TextLayout kPredictions{.row_width = 27, .cell_width = 7};

bool is_identified(const FittedParameter& parameter) {
  return parameter.verdict == Verdict::kIdentified || parameter.verdict == Verdict::kMeasured;
}

/// Whether the value is one that the data gave, trusted or not.
bool is_found(const FittedParameter& parameter) {
  return is_identified(parameter) || parameter.verdict == Verdict::kUncertain;
}

/// Whether the value is one that the data do not show, but the fit is worse without.
bool is_kept_as_fitted(const FittedParameter& parameter) {
  const double size = std::max(std::abs(parameter.value), std::abs(parameter.start));
  return (parameter.verdict == Verdict::kUnidentified || parameter.verdict == Verdict::kAtBound) &&
         std::abs(parameter.value - parameter.start) > kSameValue * size;
}

/// Digits so that the uncertainty shows with two of them.
std::string with_digits_of(double sigma, double value) {
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
  if (p.relative > 9.99) {
    return "> 999 %";
  }
  return p.relative > 0.995 ? fmt::format("{:.0f} %", 100.0 * p.relative)
                            : fmt::format("{:.2g} %", 100.0 * p.relative);
}

/// Where the value of a parameter comes from, in a word of the table.
std::string origin_of(const FittedParameter& p) { return std::string(verdict_name(p.verdict)); }

Line parameter_line(const FittedParameter& p) {
  const bool has_sigma = is_found(p) && p.sigma > 0.0;
  return {.row = p.name,
          .what = unit_of(p.key),
          .cells = {{with_digits_of(has_sigma ? p.sigma : 0.0, p.value)},
                    {has_sigma ? with_digits_of(p.sigma, p.sigma) : ""},
                    {is_found(p) ? relative_text(p) : ""}},
          .note = origin_of(p)};
}

/// "moving mass: shows only together with ..." in lines of the terminal's width.
std::string reason_text(const FittedParameter& p) {
  std::string text;
  std::string line = "  " + p.name + ":";
  std::istringstream words(p.why);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kReasonWidth) {
      text += line + "\n";
      line = "   ";
    }
    line += " " + word;
  }
  return text + line + "\n";
}

/// What the residual says of the fit.
std::string residual_text(const AxisFit& fit) {
  std::string text = fmt::format("residual {:.3g} um RMS", units::um_from_mm(fit.residual_rms));
  if (fit.scale_rms > 0.0) {
    text += fmt::format(", {:.3g} um of the scale on the table", units::um_from_mm(fit.scale_rms));
  }
  if (!(fit.rounding_rms > 0.0)) {
    return text + "\n";
  }
  text += fmt::format("{}rounding to counts alone makes {:.3g} um\n",
                      fit.scale_rms > 0.0 ? ";\n" : "; ", units::um_from_mm(fit.rounding_rms));
  if (fit.residual_rms > kLackOfFit * fit.rounding_rms) {
    text += fmt::format(
        "{:.3g} times what rounding makes: the model lacks something, and what is\n"
        "uncertain may be off by more than its deviation\n",
        fit.residual_rms / fit.rounding_rms);
  }
  if (!fit.seems_to_lack.empty()) {
    text += fmt::format("the residual goes with {}\n", fmt::join(fit.seems_to_lack, ", "));
  }
  if (!fit.would_explain.empty()) {
    text += fit.would_explain + "\n";
  }
  return text;
}

std::string axis_table(const AxisFit& fit, hal::Axis axis) {
  TextTable table;
  table.row_head = axis == hal::kX ? "X axis" : "Y axis";
  table.head = {"value", "sigma", "relative"};
  std::string reasons;
  std::string held;
  std::string doubts;
  for (const FittedParameter& parameter : fit.parameters) {
    table.lines.push_back(parameter_line(parameter));
    std::string& list = parameter.verdict == Verdict::kUncertain ? doubts
                        : is_kept_as_fitted(parameter)           ? held
                                                                 : reasons;
    list += parameter.why.empty() ? "" : reason_text(parameter);
  }
  for (const FittedParameter& parameter : fit.derived) {
    table.lines.push_back(parameter_line(parameter));
  }
  std::string text = "\n" + to_text(table, kParameters) + residual_text(fit);
  if (fit.inverse) {
    text += inverse_table(*fit.inverse, *fit.two_way);
  }
  text += doubts.empty() ? "" : "uncertain:\n" + doubts;
  text += held.empty()
              ? ""
              : "not shown, these are kept where the fit had them, since at their starting\n"
                "values it would be worse:\n" +
                    held;
  return reasons.empty() ? text : text + "not shown, these keep their starting values:\n" + reasons;
}

/// Tracking errors measured and of the identified machine.
std::string prediction_table(const std::vector<Prediction>& predictions) {
  TextTable table;
  table.row_head = "tracking error [um]";
  table.head = {"measured RMS", "max", "model RMS", "max", "change"};
  for (const Prediction& p : predictions) {
    const auto cell = [](double error) {
      return Cell{fmt::format("{:.3f}", units::um_from_mm(error))};
    };
    table.lines.push_back(
        {.row = std::filesystem::path(p.trace).filename().string(),
         .what = p.axis == hal::kX ? "X" : "Y",
         .cells = {cell(p.measured.rms),
                   cell(p.measured.max),
                   cell(p.simulated.rms),
                   cell(p.simulated.max),
                   {fmt::format("{:+.1f} %", 100.0 * (p.simulated.rms / p.measured.rms - 1.0))}},
         .note = {}});
  }
  return to_text(table, kPredictions);
}

/// Where a value comes from, for the machine file.
std::string comment(const FittedParameter& p) {
  switch (p.verdict) {
    case Verdict::kIdentified:
      return fmt::format("identified, 1 sigma {} ({})", with_digits_of(p.sigma, p.sigma),
                         relative_text(p));
    case Verdict::kMeasured:
      return "read off the trace";
    case Verdict::kUncertain:
      return "uncertain" + (p.why.empty() ? "" : ": " + p.why);
    case Verdict::kUnidentified:
    case Verdict::kAtBound:
      return (is_kept_as_fitted(p) ? "not shown, kept as fitted: "
                                   : "not shown, starting value: ") +
             p.why;
    case Verdict::kFixed:
      return "fixed";
  }
  return {};
}

Json parameter_json(const FittedParameter& p) {
  Json entry{{"key", p.key},
             {"name", p.name},
             {"start", rounded(p.start)},
             {"value", rounded(p.value)},
             {"sigma", rounded(p.sigma)},
             {"relative_sigma", rounded(p.relative)},
             {"identified", is_identified(p)},
             {"verdict", verdict_name(p.verdict)}};
  if (!p.why.empty()) {
    entry["why"] = p.why;
  }
  return entry;
}

Json axis_json(const AxisFit& fit) {
  Json json{{"residual_rms_um", rounded(units::um_from_mm(fit.residual_rms))},
            {"scale_residual_rms_um", rounded(units::um_from_mm(fit.scale_rms))},
            {"rounding_rms_um", rounded(units::um_from_mm(fit.rounding_rms))},
            {"search_evaluations", fit.evaluations},
            {"residual_goes_with", fit.seems_to_lack},
            {"would_explain_residual", fit.would_explain},
            {"parameters", Json::array()},
            {"derived", Json::array()}};
  for (const FittedParameter& p : fit.parameters) {
    json["parameters"].push_back(parameter_json(p));
  }
  for (const FittedParameter& p : fit.derived) {
    json["derived"].push_back(parameter_json(p));
  }
  if (fit.inverse) {
    json["inverse_model"] = inverse_json(*fit.inverse);
    json["inverse_model_two_way"] = inverse_json(*fit.two_way);
  }
  return json;
}

/// Whether the fit of an axis has found a parameter of it.
bool shows_something(const std::optional<AxisFit>& fit) {
  return fit && std::ranges::any_of(fit->parameters, is_identified);
}

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentified:
      return "identified";
    case Verdict::kMeasured:
      return "measured";
    case Verdict::kUncertain:
      return "uncertain";
    case Verdict::kUnidentified:
    case Verdict::kAtBound:
      return "not shown";
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
      text += fmt::format("\n{} axis: did not move or was not recorded; not identified\n",
                          axis == hal::kX ? "X" : "Y");
    }
  }
  text += "\n" + prediction_table(result.predictions);
  for (const Validation& validation : result.validations) {
    text += "\n" + validation_table(validation);
  }
  return text;
}

std::string to_json(const Identification& result, const std::filesystem::path& machine_file) {
  Json json;
  json["machine_file"] = machine_file.string();
  json["period_s"] = rounded(result.machine.period);
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    json["axis"][axis == hal::kX ? "x" : "y"] =
        result.axis[axis] ? axis_json(*result.axis[axis]) : Json(nullptr);
  }
  json["predictions"] = Json::array();
  for (const Prediction& p : result.predictions) {
    json["predictions"].push_back({{"trace", p.trace},
                                   {"axis", p.axis == hal::kX ? "x" : "y"},
                                   {"measured_tracking_error_um", error_json(p.measured)},
                                   {"simulated_tracking_error_um", error_json(p.simulated)}});
  }
  json["validations"] = Json::array();
  for (const Validation& validation : result.validations) {
    json["validations"].push_back(validation_json(validation));
  }
  json["notes"] = result.notes;
  return to_text(json);
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
  config::MachineFile machine = result.machine;
  machine.table.is_identified =
      machine.table.is_identified || std::ranges::any_of(result.axis, shows_something);
  return text + config::to_toml(machine, [&comments](const std::string& path) {
           const auto found = comments.find(path);
           return found == comments.end() ? std::string() : found->second;
         });
}

}  // namespace twin::studies::identify
