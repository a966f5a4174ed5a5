#include "hal/rig/rig_machine.hpp"

#include <cmath>
#include <utility>

namespace twin::hal::rig {

RigMachine::RigMachine(RigSettings settings, const TableScales& table, CardsFactory open_cards,
                       std::shared_ptr<Bench> bench, Watch* watch)
    : settings_(std::move(settings)),
      drives_(settings_.axis.begin(), settings_.axis.end()),
      open_cards_(std::move(open_cards)),
      bench_(std::move(bench)),
      watch_(watch) {
  info_.name = "rig";
  info_.simulated = bench_ != nullptr;
  info_.has_truth = bench_ != nullptr;
  info_.keeps_own_time = bench_ == nullptr || bench_->keeps_own_time();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    info_.mm_per_count[axis] = drives_[axis].mm_per_count(table.mm_per_count[axis]);
    info_.mm_per_s_per_volt[axis] = drives_[axis].mm_per_s_per_volt(table.mm_per_s_per_volt[axis]);
  }
}

RigMachine::~RigMachine() { deactivate(); }

Status RigMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    return stop_with(Fault::kNotConfigured);
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  if (state_ == State::kActive && has_guard_acted()) {
    return stop_with(Fault::kGuard);
  }
  if (bench_ != nullptr && !bench_->advance()) {
    return stop_with(Fault::kBench);
  }
  CardInputs card;
  if (cards_->read(card) == Status::kError) {
    return stop_with(Fault::kCards);
  }
  fill(card, inputs);
  return Status::kOk;
}

void RigMachine::fill(const CardInputs& card, Inputs& inputs) const noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const auto counter = static_cast<std::size_t>(settings_.axis[axis].counter);
    const DriveInputs drive = drives_[axis].decode(card.digital, servo_on_[axis]);
    inputs.counts[axis] = card.counts[counter] - home_[axis];
    inputs.servo_ready[axis] = drive.ready;
    inputs.alarm[axis] = drive.alarm;
    inputs.limit_positive[axis] = drive.limit_positive;
    inputs.limit_negative[axis] = drive.limit_negative;
    inputs.index[axis] = (card.index_seen >> counter & 1) != 0;
  }
}

CardOutputs RigMachine::card_outputs(const Outputs& outputs) const noexcept {
  CardOutputs card;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const bool servo_on = outputs.servo_on[axis];
    card.digital = drives_[axis].with_outputs(servo_on, false, card.digital);
    card.volts[static_cast<std::size_t>(settings_.axis[axis].dac)] =
        drives_[axis].vref(outputs.volts[axis], servo_on);
  }
  return card;
}

Status RigMachine::write(const Outputs& outputs) noexcept {
  if (state_ != State::kActive) {
    return stop_with(Fault::kNotActive);
  }
  if (!std::isfinite(outputs.volts[kX]) || !std::isfinite(outputs.volts[kY]) ||
      !std::isfinite(outputs.position_reference[2])) {
    return stop_with(Fault::kNotANumber);
  }
  if (has_guard_acted()) {
    return stop_with(Fault::kGuard);
  }
  if (watch_ != nullptr && !watch_->is_alive()) {
    return stop_with(Fault::kGuardGone);
  }
  if (watch_ != nullptr && !is_armed_) {
    is_armed_ = true;
    watch_->arm();
  }
  if (bench_ != nullptr) {
    bench_->set_pen_reference(outputs.position_reference[2]);
  }
  servo_on_ = outputs.servo_on;
  if (cards_->write(card_outputs(outputs)) == Status::kError) {
    return stop_with(Fault::kCards);
  }
  if (watch_ != nullptr) {
    watch_->beat();
    if (watch_->has_acted()) {  // while this write was under way: it must not be the last
      return stop_with(Fault::kGuard);
    }
  }
  return Status::kOk;
}

Truth RigMachine::truth() const noexcept {
  Truth truth;
  if (bench_ != nullptr && state_ != State::kUnconfigured) {
    truth = bench_->truth();
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      truth.table_position[axis] -= origin_.table_position[axis];
    }
  }
  return truth;
}

Status RigMachine::stop_with(Fault fault) noexcept {
  deactivate();
  fault_ = fault;
  return Status::kError;
}

std::string RigMachine::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kNotConfigured:
      return "the rig was read before it was configured";
    case Fault::kNotActive:
      return "the rig was written to while it was not active";
    case Fault::kNotANumber:
      return "a drive command or the pen's reference is not a finite number";
    case Fault::kCards:
      return cards_->last_error();
    case Fault::kBench:
      return bench_->last_error();
    case Fault::kGuard:
      return "the guard has made the outputs safe: heartbeats were missing for too long";
    case Fault::kGuardGone:
      return "the guard process is gone: nothing would make the outputs safe if this one hung";
  }
  return {};
}

}  // namespace twin::hal::rig
