#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/units.hpp"
#include "studies/identify/axis_fitter.hpp"
#include "studies/identify/torque_servo.hpp"

// The parts of a fit that are about the motor's force, and about what deviations do not say.
namespace twin::studies::identify {
namespace {

constexpr double kStiffWay = 1e-3;        // that Coulomb friction bends its spring by [mm]
constexpr double kTorqueReserve = 1.5;    // over the largest torque recorded
constexpr double kMostTorqueDelay = 3.0;  // that is looked for [periods]
constexpr double kDelayPrecision = 0.01;  // [periods]
constexpr double kForceWeight = 0.5;      // of the RMS of the force beside that of the position
constexpr double kFineTolerance = 1e-7;   // of the last local search
constexpr double kNoticed = 0.02;         // of the force, from which on a load is noticed
constexpr double kUsualKp = 100.0;        // [1/s]
constexpr double kLeastKp = 6.0;
constexpr double kMostKp = 900.0;

}  // namespace

/// Gives a searched parameter the value that the force tells, and holds it there.
/// @param is_held  whether it is held there, or only where the search begins
void AxisFitter::take_coefficient(const std::string& name, const Coefficient& coefficient,
                                  double to_unit, bool is_held) {
  const auto found = std::ranges::find_if(
      searched_, [&](const Searched& p) { return p.result.key.ends_with(name); });
  if (found == searched_.end() || found->result.verdict == Verdict::kFixed) {
    return;
  }
  FittedParameter& result = found->result;
  const ParameterSet one = ParameterSet::create({found->candidate.parameter}).value();
  current_ = one.with_values(current_, std::vector<double>{coefficient.value * to_unit});
  if (!is_held) {
    return;
  }
  found->is_held = found->is_measured = true;
  result.sigma = coefficient.sigma * to_unit;
  result.relative = coefficient.sigma / std::max(std::abs(coefficient.value), 1e-12);
  result.verdict = result.relative > kMostRelative ? Verdict::kUncertain : Verdict::kIdentified;
  result.why = result.relative > kMostRelative ? "the force shows it poorly" : "";
  if (coefficient.value <= 0.0) {
    result.verdict = Verdict::kUncertain;
    result.why = fmt::format("is {:.4g} by the force: is the force's sign or scale right?",
                             coefficient.value * to_unit);
  }
}

/// The inverse model, with friction that is the same either way and with one that differs.
void AxisFitter::fit_inverse_models() {
  const double quantum = std::abs(current_.table.axis[problem_.axis()].encoder.mm_per_count);
  const auto fit = [&](Directions directions) {
    return fit_inverse_model(problem_.all_records(), current_.period, quantum, directions);
  };
  fit_.inverse = fit(Directions::kAlike);
  if (fit_.inverse->mass.value < 0.0 && !is_torque_mode()) {
    fit_.notes.push_back("the motor's force counts the other way than the position; turned round");
    problem_.turn_force();
    for (AxisRecord& record : records_) {
      std::ranges::for_each(record.force, [](double& force) { force = -force; });
    }
    fit_.turns_force = true;
    fit_.inverse = fit(Directions::kAlike);
  }
  fit_.two_way = fit(Directions::kTwoWay);
}

/// Adds a parameter that no search fits, with what the force says of it.
void AxisFitter::add_load(const std::string& key, const char* name, double& field, double start,
                          const Coefficient& coefficient, double to_unit) {
  FittedParameter& parameter = loads_.emplace_back();
  parameter.key = table_section(problem_.axis()) + key;
  parameter.name = name;
  parameter.start = parameter.value = start * to_unit;
  if (options_.is_fixed(parameter.key)) {
    parameter.verdict = Verdict::kFixed;
    return;
  }
  field = coefficient.value;
  parameter.value = field * to_unit;
  parameter.sigma = coefficient.sigma * to_unit;
  parameter.relative =
      coefficient.sigma / std::max(std::abs(coefficient.value), kNoticed * fit_.inverse->force_rms);
  parameter.verdict = Verdict::kIdentified;
  if (parameter.relative > kMostRelative) {
    parameter.verdict = Verdict::kUncertain;
    parameter.why = "shows only together with friction that differs either way";
  }
}

/// Weight, and asymmetry of friction where the user frees it.
void AxisFitter::take_loads(const InverseModel& model) {
  hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
  const hal::mujoco::AxisParams& start = start_.table.axis[problem_.axis()];
  loads_.clear();
  if (model.has_both_directions) {
    add_load("weight_N", "weight", axis.load.weight, start.load.weight, model.weight, 1.0);
  } else {
    FittedParameter& weight = loads_.emplace_back();
    weight.key = table_section(problem_.axis()) + "weight_N";
    weight.name = "weight";
    weight.start = weight.value = axis.load.weight;
    weight.verdict = Verdict::kUnidentified;
    weight.why = "the axis moves in one direction only: shows only together with Coulomb friction";
  }
  if (fit_.takes_two_way) {
    Coefficient taken = model.viscous_asymmetry;
    taken.value = std::clamp(taken.value, -axis.friction.viscous, axis.friction.viscous);
    add_load("viscous_asymmetry_N_s_per_m", "viscous friction, asymmetry",
             axis.friction.viscous_asymmetry, start.friction.viscous_asymmetry, taken, 1e3);
  }
}

/// Raises the torque limit of a motor that gave more than the machine file lets it.
void AxisFitter::raise_peak_torque() {
  hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
  double largest = 0.0;
  for (const AxisRecord& record : problem_.all_records()) {
    for (const double force : record.force) {
      largest = std::max(largest, std::abs(force));
    }
  }
  const double torque = largest * units::m_from_mm(axis.mm_per_rad());
  axis.motor.peak_torque = std::max(axis.motor.peak_torque, kTorqueReserve * torque);
}

/// Mass, friction and weight from the force of the motor.
void AxisFitter::estimate_inverse() {
  fit_inverse_models();
  fit_.takes_two_way =
      options_.is_freed(table_section(problem_.axis()) + "viscous_asymmetry_N_s_per_m");
  const InverseModel& model = *fit_.used_inverse();
  Coefficient slide = model.mass;
  slide.value -= current_.table.axis[problem_.axis()].rotor_mass();
  take_coefficient("moving_mass_kg", slide, 1.0);
  // Where the model fits, positions show friction relative to the mass far better than the force.
  const bool holds_friction = is_torque_mode() || holds_friction_;
  if (holds_friction || !fit_.trained) {
    take_coefficient("coulomb_friction_N", model.coulomb, 1.0, holds_friction);
    take_coefficient("viscous_friction_N_s_per_m", model.viscous, 1e3, holds_friction);
  }
  take_loads(model);
  FittedParameter total;
  total.name = "mass with rotor [kg]";
  total.value = model.mass.value;
  total.sigma = model.mass.sigma;
  total.relative = total.sigma / std::max(std::abs(total.value), 1e-12);
  total.verdict = total.relative > kMostRelative ? Verdict::kUncertain : Verdict::kIdentified;
  fit_.derived = {total};
  raise_peak_torque();
}

/// Where the model does not fit, friction is that of the force, and the force is fitted beside the
/// positions.
void AxisFitter::hold_friction_where_unfit() {
  const bool is_fit = rms_of(current_) <= kLackOfFit * fit_.rounding_rms;
  if (!problem_.has_force() || holds_friction_ || is_fit) {
    return;
  }
  holds_friction_ = true;
  estimate_inverse();
  polish(30);
  const double force =
      problem_.force_difference(current_).norm() / std::sqrt(static_cast<double>(problem_.rows()));
  if (force > 0.0) {
    problem_.weigh_force(kForceWeight * rms_of(current_) / force);
    polish(30);
  }
}

/// The servo's gains where nothing but the steady lag L = (1 - Kf) / Kp tells them: the start that
/// fits better, Kf = 0 with Kp = 1 / L, or a usual Kp with Kf = 1 - Kp L.
void AxisFitter::begin_from_steady_lag() {
  const FittedParameter lag = measure_velocity_lag(problem_);
  if (lag.verdict == Verdict::kUnidentified || !is_free("kp_per_s") || !is_free("kf")) {
    return;
  }
  const double seconds = lag.value * 1e-3;
  motion::Gains& gains = current_.servo[problem_.axis()];
  const motion::Gains given = gains;
  config::MachineFile best = current_;
  double least = rms_of(current_);
  std::vector<double> tried{given.kp, kUsualKp};
  if (seconds > 0.0) {
    tried.push_back(1.0 / seconds);
  }
  for (const double kp : tried) {
    gains = given;
    gains.kp = std::clamp(kp, kLeastKp, kMostKp);
    gains.kf = std::clamp(1.0 - gains.kp * seconds, -1.5, 1.5);
    hal::mujoco::DriveParams& drive = current_.table.axis[problem_.axis()].drive;
    const double offset = drive.vref_offset;
    const double rms = rms_of(current_);
    drive.vref_offset = offset;
    if (rms < least) {
      least = rms;
      best = current_;
    }
  }
  current_ = best;
}

/// Keeps the machine that knows the first parts of the records only, and goes on with all of them.
void AxisFitter::join_held_out() {
  if (records_.empty()) {
    return;
  }
  fit_.trained = current_;
  fit_.trained_inverse = fit_.used_inverse();
  problem_.set_records(std::move(records_));
  records_.clear();
  if (problem_.has_force()) {
    estimate_inverse();
  }
  if (is_torque_mode()) {
    estimate_gains();
    complete_torque_mode();
    return;
  }
  align();
  polish(40, 0, kFineTolerance);
}

double AxisFitter::closed_loop_rms() const {
  double sum = 0.0;
  double rows = 0.0;
  for (const AxisRecord& record : problem_.all_records()) {
    const AxisRun run = follow_record(current_, problem_.axis(), record);
    for (std::size_t k = settling_rows(record, current_.period); k < run.rows.size(); ++k) {
      if (record.counts(k)) {
        sum += std::pow(record.measured[k] - run.rows[k].feedback, 2);
        rows += 1.0;
      }
    }
  }
  return std::sqrt(sum / std::max(rows, 1.0));
}

/// What the force does not show of an axis in torque mode: friction without Stribeck curve and
/// bristles, and the dead time of the torque, by the closed loop.
void AxisFitter::complete_torque_mode() {
  hal::mujoco::AxisParams& axis = current_.table.axis[problem_.axis()];
  if (start_.table.axis[problem_.axis()].friction.law == hal::mujoco::FrictionLaw::kLugre) {
    axis.friction.law = hal::mujoco::FrictionLaw::kCoulomb;
    axis.friction.bristle_stiffness = std::clamp(axis.friction.coulomb / kStiffWay, 1e-1, 1e6);
  }
  delay_ = {};
  delay_.key = table_section(problem_.axis()) + "output_delay_ms";
  delay_.name = "output delay";
  delay_.start = delay_.value = start_.table.axis[problem_.axis()].drive.output_delay * 1e3;
  if (options_.is_fixed(delay_.key)) {
    delay_.verdict = Verdict::kFixed;
    return;
  }
  axis.motor.current_lag = 0.0;
  double low = 0.0;
  double high = kMostTorqueDelay * current_.period;
  const auto rms_at = [&](double delay) {
    axis.drive.output_delay = delay;
    return closed_loop_rms();
  };
  while (high - low > kDelayPrecision * current_.period) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    if (rms_at(a) < rms_at(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  axis.drive.output_delay = 0.5 * (low + high);
  delay_.value = axis.drive.output_delay * 1e3;
  delay_.verdict = Verdict::kUncertain;
  delay_.why = "stands for the lag of the current loop, too";
}

/// In torque mode nothing is left to search for: force and drive commands tell all there is.
AxisFit AxisFitter::finish_torque_mode() {
  if (start_.table.axis[problem_.axis()].friction.law == hal::mujoco::FrictionLaw::kLugre) {
    fit_.notes.push_back(
        "friction_law is coulomb: the force shows no Stribeck curve and no bristles");
  }
  fit_.residual_rms = closed_loop_rms();
  fit_.machine = current_;
  for (Searched& parameter : searched_) {
    if (parameter.is_measured || parameter.result.verdict == Verdict::kFixed) {
      const ParameterSet one = ParameterSet::create({parameter.candidate.parameter}).value();
      parameter.result.value = one.values(current_).front();
      fit_.parameters.push_back(std::move(parameter.result));
    }
  }
  fit_.parameters.push_back(std::move(delay_));
  fit_.parameters.push_back(std::move(count_));
  std::ranges::move(loads_, std::back_inserter(fit_.parameters));
  std::ranges::move(gains_, std::back_inserter(fit_.parameters));
  fit_.was_stopped = options_.stop != nullptr && options_.stop->load();
  report(1.0);
  return std::move(fit_);
}

}  // namespace twin::studies::identify
