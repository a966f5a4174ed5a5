#include "studies/identify/axis_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/mujoco/table_settings.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kUnstable = 1e3;  // residual of a motion that ran away [mm]

/// Drops what is slower than a time constant, and the first value.
void filter(Eigen::Ref<Eigen::VectorXd> values, double period) {
  const double keep = std::exp(-period / AxisProblem::kForgetting);
  double last = values.size() > 0 ? values[0] : 0.0;
  double filtered = 0.0;
  for (double& value : values) {
    filtered = keep * (filtered + value - last);
    last = value;
    value = filtered;
  }
}

}  // namespace

AxisProblem::AxisProblem(config::MachineFile base, hal::Axis axis, std::vector<AxisRecord> records)
    : base_(std::move(base)),
      axis_(axis),
      records_(std::move(records)),
      hum_phase_(records_.size(), 0.0) {
  use(records_.size());
}

void AxisProblem::use(std::size_t count) noexcept {
  used_ = std::min(count, records_.size());
  rows_ = 0;
  for (const AxisRecord& record : records()) {
    rows_ += static_cast<Eigen::Index>(record.measured.size());
  }
}

Eigen::VectorXd AxisProblem::difference(const config::MachineFile& machine, std::size_t record,
                                        double hum_phase) const {
  const AxisRecord& data = records_[record];
  AxisSetup setup = axis_setup(machine, axis_);
  setup.axis.travel = kFarTravel;
  setup.axis.drive.hum_phase += hum_phase;
  if (!data.has_volts()) {
    setup.axis.dac_bits =
        hal::mujoco::kMaxDacBits;  // steps of a converter would make the residual rough
  }
  AxisModel model(setup, data.command.front().position);
  model.settle(data.command.front().position);
  motion::AxisServo servo(setup.servo, setup.axis.mm_per_s_per_volt(), setup.period);
  Eigen::VectorXd result(static_cast<Eigen::Index>(data.measured.size()));
  for (std::size_t k = 0; k < data.measured.size(); ++k) {
    const double volts =
        data.has_volts() ? data.volts[k] : servo.update(data.command[k], data.measured[k]);
    result[static_cast<Eigen::Index>(k)] = data.measured[k] - model.drive(volts).table;
  }
  if (model.has_failed()) {
    result.setConstant(kUnstable);
  }
  return result;
}

double AxisProblem::cost(std::size_t record, double hum_phase) const {
  Eigen::VectorXd values = difference(base_, record, hum_phase);
  filter(values, base_.period);
  return values.squaredNorm();
}

Eigen::VectorXd AxisProblem::residuals(const ParameterSet& set,
                                       std::span<const double> units) const {
  const config::MachineFile machine = set.with_units(base_, units);
  Eigen::VectorXd all(rows_);
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Eigen::VectorXd one = difference(machine, i);
    all.segment(begin, one.size()) = one;
    if (std::abs(one[0]) < kUnstable) {
      filter(all.segment(begin, one.size()), machine.period);
    }
    begin += one.size();
  }
  return all;
}

}  // namespace twin::studies::identify
