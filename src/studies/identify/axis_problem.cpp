#include "studies/identify/axis_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/mujoco/table_settings.hpp"
#include "studies/identify/quantum.hpp"

namespace twin::studies::identify {
namespace {

constexpr int kCountPlaces = 4;    // that rounding is tried with
constexpr double kUnstable = 1e3;  // residual of a motion that ran away [mm]

constexpr double kMostScaleWeight = 10.0;

/// Count of the first signal that has one [mm]; 0 where none has.
double count_of(std::span<const AxisRecord> records, std::vector<double> AxisRecord::*signal) {
  for (const AxisRecord& record : records) {
    if (const auto count = quantum_of(record.*signal); count && !(record.*signal).empty()) {
      return *count;
    }
  }
  return 0.0;
}

}  // namespace

AxisProblem::AxisProblem(config::MachineFile base, hal::Axis axis, std::vector<AxisRecord> records)
    : base_(std::move(base)),
      axis_(axis),
      records_(std::move(records)),
      hum_phase_(records_.size(), 0.0) {
  make_tables();
  use(records_.size());
}

/// Looks at the sides of the table, and weighs scales by how much finer than encoders they are.
void AxisProblem::make_tables() {
  tables_.clear();
  const bool has_motor = !std::ranges::all_of(records_, &AxisRecord::is_at_table);
  for (const AxisRecord& record : records_) {
    if (ever_shows_table()) {
      tables_.push_back({TableSide(record, base_.period, kForgetting,
                                   record.has_scale() || (has_motor && record.is_at_table)),
                         record.has_scale() ? quantum_of(record.scale).value_or(0.0) : 0.0});
    }
  }
  const double count = count_of(records_, &AxisRecord::scale);
  scale_weight_ = count > 0.0 ? std::clamp(count_of(records_, &AxisRecord::measured) / count, 1.0,
                                           kMostScaleWeight)
                              : 1.0;
}

bool AxisProblem::shows_table() const {
  return std::ranges::any_of(records(), &AxisRecord::shows_table);
}

bool AxisProblem::ever_shows_table() const {
  return std::ranges::any_of(records_, &AxisRecord::shows_table);
}

Eigen::Index AxisProblem::size() const noexcept {
  return scales_begin() + (has_scale_ ? rows_ : 0);
}

/// Makes residuals of the measured position.
void AxisProblem::take(Eigen::Ref<Eigen::VectorXd> position, std::size_t record) const {
  if (records_[record].is_at_table) {
    tables_[record].side.take(position, records_[record]);
    return;
  }
  drop_slow(position, records_[record], base_.period, kForgetting,
            settling_rows(records_[record], base_.period));
}

void AxisProblem::set_records(std::vector<AxisRecord> records) {
  const std::size_t in_use = used_;
  records_ = std::move(records);
  hum_phase_.resize(records_.size(), 0.0);
  make_tables();
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
  has_scale_ = std::ranges::any_of(records(), &AxisRecord::has_scale);
}

AxisProblem::Apart AxisProblem::apart(const config::MachineFile& machine, std::size_t record,
                                      double hum_phase) const {
  const AxisRecord& data = records_[record];
  AxisSetup setup = axis_setup(machine, axis_);
  setup.axis.travel = kFarTravel;
  setup.axis.drive.hum_phase += hum_phase;
  setup.axis.encoder.place = place_of(data);
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
  Apart result{Eigen::VectorXd(rows), Eigen::VectorXd::Zero(rows),
               Eigen::VectorXd::Zero(data.has_scale() ? rows : 0)};
  const std::size_t settling = settling_rows(data, setup.period);
  for (std::size_t k = 0; k < data.measured.size(); ++k) {
    const double volts =
        data.has_volts() ? data.volts[k] : servo.update(data.command[k], data.measured[k]);
    const AxisRow row = model.drive(volts);
    result.position[static_cast<Eigen::Index>(k)] = data.measured[k] - row.feedback;
    if (data.has_force() && k >= settling && data.counts(k)) {
      result.force[static_cast<Eigen::Index>(k)] = data.force[k] - row.force;
    }
    if (data.has_scale()) {
      result.scale[static_cast<Eigen::Index>(k)] = data.scale[k] - row.table;
    }
  }
  if (model.has_failed()) {
    result.position.setConstant(kUnstable);
  }
  return result;
}

std::vector<Eigen::VectorXd> AxisProblem::rounding_errors() const {
  const double count = std::abs(base_.table.axis[axis_].encoder.mm_per_count);
  std::vector<Eigen::VectorXd> all(kCountPlaces, Eigen::VectorXd::Zero(size()));
  const auto rounding = [](double x, double of, int place) {
    const double counts = x / of + static_cast<double>(place) / kCountPlaces;
    return of * (std::round(counts) - counts);
  };
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Apart both = apart(base_, i, hum_phase_[i]);
    const AxisRecord& record = records_[i];
    const Eigen::Index rows = both.position.size();
    for (int place = 0; place < kCountPlaces; ++place) {
      Eigen::VectorXd& errors = all[static_cast<std::size_t>(place)];
      auto part = errors.segment(begin, rows);
      for (Eigen::Index k = 0; k < rows; ++k) {
        part[k] =
            rounding(record.measured[static_cast<std::size_t>(k)] - both.position[k], count, place);
      }
      take(part, i);
      if (!record.has_scale() || !(tables_[i].count > 0.0)) {
        continue;
      }
      auto of_scale = errors.segment(scales_begin() + begin, rows);
      for (Eigen::Index k = 0; k < rows; ++k) {
        of_scale[k] = rounding(record.scale[static_cast<std::size_t>(k)] - both.scale[k],
                               tables_[i].count, place);
      }
      tables_[i].side.take(of_scale, record);
      of_scale *= scale_weight_;
    }
    begin += rows;
  }
  return all;
}

double AxisProblem::cost(std::size_t record, double hum_phase) const {
  Eigen::VectorXd values = apart(base_, record, hum_phase).position;
  take(values, record);
  return values.squaredNorm();
}

Eigen::VectorXd AxisProblem::residuals(const config::MachineFile& machine) const {
  Eigen::VectorXd all(size());
  Eigen::Index begin = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Apart one = apart(machine, i, hum_phase_[i]);
    const Eigen::Index rows = one.position.size();
    all.segment(begin, rows) = one.position;
    if (std::abs(one.position[0]) < kUnstable) {
      take(all.segment(begin, rows), i);
    }
    if (force_weight_ > 0.0) {
      all.segment(rows_ + begin, rows) = force_weight_ * one.force;
    }
    if (has_scale_) {
      auto part = all.segment(scales_begin() + begin, rows);
      part.setZero();
      if (one.scale.size() > 0) {
        part = one.scale;
        tables_[i].side.take(part, records_[i]);
        part *= scale_weight_;
      }
    }
    begin += rows;
  }
  return all;
}

double AxisProblem::scale_rms(const config::MachineFile& machine) const {
  if (!has_scale_) {
    return 0.0;
  }
  const double rows = static_cast<double>(std::max<Eigen::Index>(rows_, 1));
  return residuals(machine).tail(rows_).norm() / scale_weight_ / std::sqrt(rows);
}

double AxisProblem::scale_rounding_rms() const {
  double count = 0.0;
  for (const Table& table : tables_) {
    count = std::max(count, table.count);
  }
  return count / std::sqrt(12.0);
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
