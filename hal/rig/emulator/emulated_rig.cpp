#include "hal/rig/emulator/emulated_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/wall_clock.hpp"
#include "hal/rig/boards/voltage_range.hpp"

namespace twin::hal::rig::emulator {
namespace {

constexpr std::size_t kEvents = 4096;
constexpr std::uint64_t kSlipEvery = 4;  // of so many edges one is lost

/// The signal of an output line is given; a line that is not wired never gives it.
bool is_given(const Line& line, std::uint16_t word) noexcept {
  const bool is_high = line.channel >= 0 && (word >> line.channel & 1) != 0;
  return line.channel >= 0 && is_high == (line.when == Level::kHigh);
}

/// Bit of an input line.
std::uint16_t bit(const Line& line, bool is_signal_given) noexcept {
  const bool is_high = is_signal_given == (line.when == Level::kHigh);
  return line.channel >= 0 && is_high ? static_cast<std::uint16_t>(1U << line.channel)
                                      : std::uint16_t{0};
}

}  // namespace

EmulatedRig::EmulatedRig(mujoco::TableParams table, RigSettings wiring, std::vector<Fault> faults,
                         boards::BoardRegisters* boards)
    : table_(std::move(table)),
      wiring_(std::move(wiring)),
      faults_(std::move(faults)),
      own_(boards == nullptr ? std::make_unique<boards::BoardRegisters>() : nullptr),
      boards_(boards == nullptr ? own_.get() : boards),
      events_(kEvents) {
  boards::power_on(*boards_, wiring_.pci1716_board_id, wiring_.pci1784_board_id);
}

Expected<void> EmulatedRig::power_on(double period) {
  TWIN_TRY(std::unique_ptr<mujoco::TablePlant> plant, mujoco::TablePlant::open(table_, period));
  plant_ = std::move(plant);
  period_ = period;
  struck_.assign(faults_.size(), 0);
  state_.fill(AxisState{});
  rest_.fill(RestWatch{});
  digital_out_ = 0;
  shafts_.clear();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    shafts_.emplace_back(table_.axis[axis], plant_->encoder_position(axis));
    origin_[axis] = plant_->position(axis);
  }
  boards::power_on(*boards_, wiring_.pci1716_board_id, wiring_.pci1784_board_id);
  inputs_.emplace(boards_->pci1784);
  show_inputs();
  return {};
}

bool EmulatedRig::advance() noexcept {
  if (!plant_) {
    return false;
  }
  strike_due_faults();
  const boards::Pci1716Registers& card = boards_->pci1716;
  const bool has_power = card.is_present.load();
  const std::uint16_t digital_out =
      has_power ? card.digital_out.load(std::memory_order_acquire) : std::uint16_t{0};
  notice_outputs(digital_out);
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    drive(axis, digital_out);
  }
  if (!plant_->advance()) {
    return false;
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    notice(axis);
  }
  show_counters();
  show_inputs();
  show_analogue();
  return true;
}

double EmulatedRig::dac_volts(std::size_t axis) const noexcept {
  const boards::Pci1716Registers& card = boards_->pci1716;
  if (!card.is_present.load()) {
    return 0.0;
  }
  const int channel = wiring_.axis[axis].dac;
  return volts(boards::analogue_output_range(card.dac_range.load(), channel),
               card.dac[static_cast<std::size_t>(channel)].load(std::memory_order_acquire));
}

void EmulatedRig::drive(std::size_t axis, std::uint16_t digital_out) noexcept {
  const AxisWiring& wires = wiring_.axis[axis];
  AxisState& state = state_[axis];
  const bool has_power = boards_->pci1716.is_present.load();
  double vref = is_broken(axis, FaultKind::kDacStuck) ? state.stuck_volts : dac_volts(axis);
  if (wires.vref_reversed != is_broken(axis, FaultKind::kVrefReversed)) {
    vref = -vref;
  }
  state.vref = is_broken(axis, FaultKind::kVrefOpen) ? 0.0 : vref;
  const bool is_resetting = has_power && is_given(wires.alarm_reset, digital_out);
  if (is_resetting && !state.is_resetting) {
    plant_->reset_drive(axis);
  }
  state.is_resetting = is_resetting;
  const bool servo_on = has_power && is_given(wires.servo_on, digital_out) &&
                        !is_broken(axis, FaultKind::kServoOnLost);
  plant_->command(axis, state.vref, servo_on);
}

boards::EncoderMotion EmulatedRig::encoder_motion(std::size_t axis) noexcept {
  AxisState& state = state_[axis];
  boards::EncoderMotion motion = shafts_[axis].move_to(plant_->encoder_position(axis));
  if (is_broken(axis, FaultKind::kEncoderFrozen)) {
    return {};
  }
  if (is_broken(axis, FaultKind::kEncoderSlipping)) {
    const std::uint64_t before = state.edges_slipped / kSlipEvery;
    state.edges_slipped += static_cast<std::uint64_t>(std::abs(motion.edges));
    const auto lost = static_cast<std::int64_t>(state.edges_slipped / kSlipEvery - before);
    motion.edges -= motion.edges < 0 ? -lost : lost;
  }
  motion.edges -= std::exchange(state.edges_to_lose, 0);
  if (wiring_.axis[axis].encoder_reversed != is_broken(axis, FaultKind::kEncoderSwapped)) {
    motion.edges = -motion.edges;
    motion.since_index = -motion.since_index;
  }
  return motion;
}

void EmulatedRig::show_counters() noexcept {
  std::array<boards::EncoderMotion, 4> motions{};
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    motions[static_cast<std::size_t>(wiring_.axis[axis].counter)] = encoder_motion(axis);
  }
  inputs_->move(motions, period_);
}

void EmulatedRig::show_inputs() noexcept {
  std::uint16_t word = 0;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisWiring& wires = wiring_.axis[axis];
    if (!is_broken(axis, FaultKind::kWireBroken)) {
      word |= bit(wires.alarm, plant_->has_alarm(axis));
    }
    word |= bit(wires.ready, plant_->is_ready(axis));
    word |= bit(wires.limit_positive, plant_->is_limit_positive(axis));
    word |= bit(wires.limit_negative, plant_->is_limit_negative(axis));
  }
  boards_->pci1716.digital_in.store(word, std::memory_order_release);
}

void EmulatedRig::show_analogue() noexcept {
  auto& seen = boards_->pci1716.analogue_in;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisWiring& wires = wiring_.axis[axis];
    seen[static_cast<std::size_t>(wires.dac)].store(static_cast<float>(
        is_broken(axis, FaultKind::kDacStuck) ? state_[axis].stuck_volts : dac_volts(axis)));
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    if (const int channel = wiring_.axis[axis].vref_readback; channel >= 0) {
      seen[static_cast<std::size_t>(channel)].store(static_cast<float>(state_[axis].vref));
    }
  }
}

Truth EmulatedRig::truth() const noexcept {
  Truth truth;
  for (std::size_t axis = 0; plant_ && axis < kServoAxes; ++axis) {
    truth.table_position[axis] = plant_->position(axis) - origin_[axis];
  }
  return truth;
}

void EmulatedRig::set_pen_reference(double z) noexcept {
  if (plant_) {
    plant_->set_pen_reference(z);
  }
}

std::string EmulatedRig::last_error() const {
  return plant_ ? plant_->last_error() : "the emulated rig was used before it was switched on";
}

void EmulatedRig::tell(EventKind kind, std::size_t index, std::int64_t value) noexcept {
  events_.add({.kind = kind,
               .index = index,
               .value = value,
               .plant_time = time(),
               .monotonic_ns = monotonic_ns()});
}

void EmulatedRig::strike_due_faults() noexcept {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    std::optional<double> ready = state_[fault.axis].first_ready;
    if (!has_axis(fault.kind)) {
      ready = state_[kX].first_ready;
      const std::optional<double> other = state_[kY].first_ready;
      ready = ready && other ? std::min(*ready, *other) : ready ? ready : other;
    }
    // Half a period of tolerance: the sum of periods is not exact.
    if (struck_[i] == 0 && ready && time() >= *ready + fault.time - 0.5 * period_) {
      struck_[i] = 1;
      inject(fault);
    }
  }
}

void EmulatedRig::inject(const Fault& fault) noexcept {
  AxisState& state = state_[fault.axis];
  tell(EventKind::kFault, fault.axis, static_cast<std::int64_t>(fault.kind));
  state.broken.set(static_cast<std::size_t>(fault.kind));
  switch (fault.kind) {
    case FaultKind::kEncoderLostCounts:
      state.edges_to_lose += kLostCounts;
      break;
    case FaultKind::kDacStuck:
      state.stuck_volts = dac_volts(fault.axis);
      break;
    case FaultKind::kAlarm:
      if (plant_) {
        plant_->trip(fault.axis);
      }
      break;
    case FaultKind::kLimitPositive:
    case FaultKind::kLimitNegative:
      if (plant_) {
        plant_->force_limits(fault.axis, is_broken(fault.axis, FaultKind::kLimitPositive),
                             is_broken(fault.axis, FaultKind::kLimitNegative));
      }
      break;
    case FaultKind::kCardGone1716:
      boards_->pci1716.is_present.store(false);
      break;
    case FaultKind::kCardGone1784:
      boards_->pci1784.is_present.store(false);
      break;
    default:
      break;
  }
}

void EmulatedRig::notice_outputs(std::uint16_t digital_out) noexcept {
  if (digital_out != digital_out_) {
    digital_out_ = digital_out;
    tell(EventKind::kDigitalOut, 0, digital_out);
  }
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    Event event;
    event.index = i;
    if (rest_[i].take(boards_->pci1716.dac[i].load(), time(), event)) {
      events_.add(event);
    }
  }
}

void EmulatedRig::notice(std::size_t axis) noexcept {
  AxisState& state = state_[axis];
  const auto changed = [](bool& last, bool now) { return std::exchange(last, now) != now; };
  if (changed(state.is_ready, plant_->is_ready(axis))) {
    tell(state.is_ready ? EventKind::kServoReady : EventKind::kServoOff, axis, 0);
  }
  if (changed(state.has_alarm, plant_->has_alarm(axis))) {
    tell(state.has_alarm ? EventKind::kAlarm : EventKind::kAlarmCleared, axis, 0);
  }
  if (changed(state.is_limit_positive, plant_->is_limit_positive(axis))) {
    tell(EventKind::kLimitPositive, axis, state.is_limit_positive ? 1 : 0);
  }
  if (changed(state.is_limit_negative, plant_->is_limit_negative(axis))) {
    tell(EventKind::kLimitNegative, axis, state.is_limit_negative ? 1 : 0);
  }
  if (state.is_ready && !state.first_ready) {
    state.first_ready = time();
  }
}

std::string EmulatedRig::report() const {
  std::vector<Event> events;
  for (std::size_t i = events_.first(); i < events_.written(); ++i) {
    events.push_back(events_[i]);
  }
  std::string text;
  for (const Event& event : in_order(std::move(events))) {
    text += to_string(event) + '\n';
  }
  const boards::Pci1716Registers& card = boards_->pci1716;
  const Truth end = truth();
  const std::string outputs =
      card.is_present.load()
          ? fmt::format("DAC 0 0x{:04X}, DAC 1 0x{:04X}, digital outputs 0x{:04X}",
                        card.dac[0].load(), card.dac[1].load(), card.digital_out.load())
          : "the PCI-1716 without power";
  return text + fmt::format("plant {:.6f} s: end, table x {:.3f} mm, y {:.3f} mm, {}\n", time(),
                            end.table_position[kX], end.table_position[kY], outputs);
}

}  // namespace twin::hal::rig::emulator
