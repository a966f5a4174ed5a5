#include "studies/identify/validation_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/text_table.hpp"
#include "core/units.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kPerMetre = 1e3;  // N s/mm in N s/m
constexpr TextLayout kValidation{.row_width = 34, .cell_width = 9};

Line error_line(std::string row, const results::ErrorStats& error, double of) {
  const auto um = [](double mm) { return Cell{fmt::format("{:.4g}", units::um_from_mm(mm))}; };
  return {.row = std::move(row),
          .what = "um",
          .cells = {um(error.rms),
                    um(error.max),
                    {fmt::format("{:.3g} %", 100.0 * error.rms / std::max(of, 1e-300))}},
          .note = {}};
}

/// "drive command: 0.021 V RMS of 2.1 V (1 %), max 0.1 V"
std::string signal_text(const char* name, const char* unit, const SignalErrors& errors) {
  return fmt::format("{}: {:.4g} {} RMS of {:.4g} {} ({:.3g} %), max {:.4g} {}\n", name,
                     errors.twin.rms, unit, errors.measured_rms, unit,
                     100.0 * errors.twin.rms / errors.measured_rms, errors.twin.max, unit);
}

}  // namespace

std::string validation_table(const Validation& v) {
  TextTable table;
  table.row_head =
      fmt::format("{} of {}{}", v.axis == hal::kX ? "X" : "Y",
                  std::filesystem::path(v.trace).filename().string(),
                  v.is_held_out ? fmt::format(" from row {}", v.first_row + 1) : std::string());
  table.head = {"RMS", "max", "relative"};
  table.lines = {error_line("tracking error", v.tracking, v.tracking.rms),
                 error_line("measured less twin", v.twin, v.tracking.rms),
                 error_line(fmt::format("less delay of {:.2f} ms", 1e3 * v.delay_time), v.delay,
                            v.tracking.rms),
                 error_line("less filter of 10 taps", v.filter, v.tracking.rms)};
  std::string text = v.is_held_out ? "held out: its begin was fitted, this is predicted\n"
                                   : "validation: not fitted\n";
  text += to_text(table, kValidation);
  if (v.volts) {
    text += signal_text("drive command", "V", *v.volts);
  }
  if (v.force) {
    text += signal_text("force in closed loop", "N", *v.force);
    if (v.inverse_force_error) {
      text += fmt::format("force by the inverse model: {:.3g} %; by a rigid body: {:.3g} %\n",
                          100.0 * *v.inverse_force_error,
                          100.0 * v.force->rigid_body_rms.value_or(0.0));
    }
  }
  return text;
}

Json error_json(const results::ErrorStats& error) {
  return {{"rms", rounded(units::um_from_mm(error.rms))},
          {"max", rounded(units::um_from_mm(error.max))}};
}

Json validation_json(const Validation& v) {
  Json json{{"trace", v.trace},
            {"axis", v.axis == hal::kX ? "x" : "y"},
            {"held_out", v.is_held_out},
            {"first_row", v.first_row},
            {"tracking_error_um", error_json(v.tracking)},
            {"measured_less_twin_um", error_json(v.twin)},
            {"measured_less_delay_um", error_json(v.delay)},
            {"delay_ms", rounded(1e3 * v.delay_time)},
            {"measured_less_filter_um", error_json(v.filter)}};
  const auto signal = [](const SignalErrors& errors) {
    return Json{{"measured_rms", rounded(errors.measured_rms)},
                {"twin_rms", rounded(errors.twin.rms)},
                {"twin_max", rounded(errors.twin.max)}};
  };
  if (v.volts) {
    json["drive_command_V"] = signal(*v.volts);
  }
  if (v.force) {
    json["force_N"] = signal(*v.force);
    json["force_N"]["inverse_model_relative"] = rounded_or_null(v.inverse_force_error);
    json["force_N"]["rigid_body_relative"] = rounded_or_null(v.force->rigid_body_rms);
  }
  return json;
}

std::string inverse_table(const InverseModel& alike, const InverseModel& two_way) {
  const auto line = [](const char* row, const char* unit, double a, std::string b) {
    return Line{.row = row,
                .what = unit,
                .cells = {{fmt::format("{:.5g}", a)}, {std::move(b)}},
                .note = {}};
  };
  const auto one = [](double x) { return fmt::format("{:.5g}", x); };
  const double mean = two_way.viscous.value * kPerMetre;
  const double half = two_way.viscous_asymmetry.value * kPerMetre;
  TextTable table;
  table.row_head = "by the force";
  table.head = {"alike", "either way"};
  table.lines = {
      line("mass with rotor", "kg", alike.mass.value, one(two_way.mass.value)),
      line("viscous friction, + and -", "N s/m", alike.viscous.value * kPerMetre,
           fmt::format("{:.4g}, {:.4g}", mean + half, mean - half)),
      line("Coulomb friction", "N", alike.coulomb.value, one(two_way.coulomb.value)),
      line("weight", "N", alike.weight.value, one(two_way.weight.value)),
      line("force error", "%", 100.0 * alike.relative_error, one(100.0 * two_way.relative_error))};
  std::string text = "\n" + to_text(table);
  if (!alike.seems_to_lack.empty()) {
    text += fmt::format("what is left of the force goes with\n  {}\n",
                        fmt::join(alike.seems_to_lack, "\n  "));
  }
  return text;
}

Json inverse_json(const InverseModel& model) {
  const auto coefficient = [](const Coefficient& c, double per_base) {
    return Json{{"value", rounded(c.value * per_base)}, {"sigma", rounded(c.sigma * per_base)}};
  };
  return {{"mass_with_rotor_kg", coefficient(model.mass, 1.0)},
          {"viscous_N_s_per_m", coefficient(model.viscous, kPerMetre)},
          {"viscous_asymmetry_N_s_per_m", coefficient(model.viscous_asymmetry, kPerMetre)},
          {"coulomb_N", coefficient(model.coulomb, 1.0)},
          {"weight_N", coefficient(model.weight, 1.0)},
          {"relative_error", rounded(model.relative_error)},
          {"rows", model.rows},
          {"residual_goes_with", model.seems_to_lack}};
}

}  // namespace twin::studies::identify
