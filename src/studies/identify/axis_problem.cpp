#include "studies/identify/axis_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/mujoco/table_settings.hpp"

namespace twin::studies::identify {
namespace {

constexpr int kCountPlaces = 4;    // that rounding is tried with
constexpr double kUnstable = 1e3;  // residual of a motion that ran away [mm]

/// Drops what is slower than a time constant, the first value, and rows that do not count.
void filter(Eigen::Ref<Eigen::VectorXd> values, const AxisRecord& record, double period) {
  const double keep = std::exp(-period / AxisProblem::kForgetting);
  const auto settling = static_cast<Eigen::Index>(settling_rows(record, period));
  double last = settling < values.size() ? values[settling] : 0.0;
  double filtered = 0.0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (k < settling) {
      values[k] = 0.0;
      continue;
    }
    if (!record.counts(static_cast<std::size_t>(k))) {
      values[k] = 0.0;
      continue;
    }
    filtered = keep * (filtered + values[k] - last);
    last = values[k];
    values[k] = filtered;
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

void AxisProblem::set_records(std::vector<AxisRecord> records) {
  const std::size_t in_use = used_;
  records_ = std::move(records);
  hum_phase_.resize(records_.size(), 0.0);
  use(in_use);
}

void AxisProblem::turn_force() noexcept {
  for (AxisRecord& record : records_) {
    std::ranges::for_each(record.force, [](double& force) { force = -force; });
  }
}

void AxisProblem::use(std::size_t count) noexcept {
  used_ = std::min(count, records_.size());
  rows_ = 0;
  for (const AxisRecord& record : records()) {
    rows_ += static_cast<Eigen::Index>(record.measured.size());
  }
}

AxisProblem::Apart AxisProblem::apart(const config::MachineFile& machine, std::size_t record,
                                      double hum_phase) const {
  const AxisRecord& data = records_[record];
  AxisSetup setup = axis_setup(machine, axis_);
  setup.axis.travel = kFarTravel;
  setup.axis.drive.hum_phase += hum_phase;
  if (!data.has_volts()) {
    setup.axis.dac_bits =
        hal::mujoco::kMaxDacBits;  // steps of a converter would make the residual rough
  }
  AxisModel model(setup, data.begin ? data.begin->position : data.command.front().position);
  motion::AxisServo servo(setup.servo, setup.axis.mm_per_s_per_volt(), setup.period);
  if (data.begin) {
    model.begin_moving(*data.begin);
    motion::Reference past = data.begin->command;
    past.position -= data.begin->velocity * setup.period;
    servo.begin_moving(past, data.begin->position - data.begin->velocity * setup.period,
                       data.begin->velocity);
  } else {
    model.settle(data.command.front().position);
  }
  const auto rows = static_cast<Eigen::Index>(data.measured.size());
  Apart result{Eigen::VectorXd(rows), Eigen::VectorXd::Zero(rows)};
  const std::size_t settling = settling_rows(data, setup.period);
  for (std::size_t k = 0; k < data.measured.size(); ++k) {
    const double volts =
        data.has_volts() ? data.volts[k] : servo.update(data.command[k], data.measured[k]);
    const AxisRow row = model.drive(volts);
    result.position[static_cast<Eigen::Index>(k)] = data.measured[k] - row.feedback;
    if (data.has_force() && k >= settling && data.counts(k)) {
      result.force[static_cast<Eigen::Index>(k)] = data.force[k] - row.force;
    }
  }
  if (model.has_failed()) {
    result.position.setConstant(kUnstable);
  }
  return result;
}

std::vector<Eigen::VectorXd> AxisProblem::rounding_errors() const {
  const double count = std::abs(base_.table.axis[axis_].encoder.mm_per_count);
  const Eigen::Index rows = force_weight_ > 0.0 ? 2 * rows_ : rows_;
  std::vector<Eigen::VectorXd> all(kCountPlaces, Eigen::VectorXd::Zero(rows));
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Eigen::VectorXd apart = difference(base_, i);
    for (int place = 0; place < kCountPlaces; ++place) {
      auto part = all[static_cast<std::size_t>(place)].segment(begin, apart.size());
      for (Eigen::Index k = 0; k < apart.size(); ++k) {
        const double x = records_[i].measured[static_cast<std::size_t>(k)] - apart[k];
        const double counts = x / count + static_cast<double>(place) / kCountPlaces;
        part[k] = count * (std::round(counts) - counts);
      }
      filter(part, records_[i], base_.period);
    }
    begin += apart.size();
  }
  return all;
}

double AxisProblem::cost(std::size_t record, double hum_phase) const {
  Eigen::VectorXd values = apart(base_, record, hum_phase).position;
  filter(values, records_[record], base_.period);
  return values.squaredNorm();
}

Eigen::VectorXd AxisProblem::residuals(const config::MachineFile& machine) const {
  Eigen::VectorXd all(force_weight_ > 0.0 ? 2 * rows_ : rows_);
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Apart one = apart(machine, i, hum_phase_[i]);
    const Eigen::Index rows = one.position.size();
    all.segment(begin, rows) = one.position;
    if (std::abs(one.position[0]) < kUnstable) {
      filter(all.segment(begin, rows), records_[i], machine.period);
    }
    if (force_weight_ > 0.0) {
      all.segment(rows_ + begin, rows) = force_weight_ * one.force;
    }
    begin += rows;
  }
  return all;
}

Eigen::VectorXd AxisProblem::force_difference(const config::MachineFile& machine) const {
  Eigen::VectorXd all(rows_);
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Apart one = apart(machine, i, hum_phase_[i]);
    all.segment(begin, one.force.size()) = one.force;
    begin += one.force.size();
  }
  return all;
}

}  // namespace twin::studies::identify
