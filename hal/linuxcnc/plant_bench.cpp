#include "hal/linuxcnc/plant_bench.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

namespace twin::hal::linuxcnc {
namespace {

constexpr std::size_t kPen = kServoAxes;    // axis of the pen slide in the memory
constexpr double kPenMmPerCount = 0.001;    // of a counter that it does not have [mm/count]
constexpr double kPenMmPerSPerVolt = 10.0;  // of a drive that it does not have [mm/s/V]
constexpr std::int64_t kSlipEvery = 4;      // edges of which one is lost

struct Injected {
  std::uint32_t bit;
  rig::emulator::FaultKind kind;
};
constexpr std::array kInjected{
    Injected{TWIN_FAULT_ENCODER_FROZEN, rig::emulator::FaultKind::kEncoderFrozen},
    Injected{TWIN_FAULT_VREF_OPEN, rig::emulator::FaultKind::kVrefOpen},
    Injected{TWIN_FAULT_ALARM, rig::emulator::FaultKind::kAlarm},
    Injected{TWIN_FAULT_LIMIT_POSITIVE, rig::emulator::FaultKind::kLimitPositive},
    Injected{TWIN_FAULT_LIMIT_NEGATIVE, rig::emulator::FaultKind::kLimitNegative},
    Injected{TWIN_FAULT_WIRE_BROKEN, rig::emulator::FaultKind::kWireBroken}};

void name_axis(twin_axis& axis, std::string_view name, std::uint32_t kind) noexcept {
  std::memset(axis.name, 0, sizeof axis.name);
  std::copy_n(name.begin(), std::min(name.size(), sizeof axis.name - 1), std::begin(axis.name));
  axis.kind = kind;
}

}  // namespace

Expected<std::unique_ptr<PlantBench>> PlantBench::open(PlantSetup setup) {
  for (const rig::emulator::Fault& fault : setup.faults) {
    if (!has_axis(fault.kind)) {
      return fail(ErrorCode::kUsage, std::string("fault ") + std::string(to_string(fault.kind)) +
                                         " is about a card of the rig, and LinuxCNC's plant has "
                                         "none");
    }
  }
  TWIN_TRY(std::unique_ptr<mujoco::TablePlant> plant,
           mujoco::TablePlant::open(setup.table, setup.period));
  return std::unique_ptr<PlantBench>(new PlantBench(std::move(setup), std::move(plant)));
}

PlantBench::PlantBench(PlantSetup setup, std::unique_ptr<mujoco::TablePlant> plant)
    : setup_(std::move(setup)), plant_(std::move(plant)), struck_(setup_.faults.size(), 0) {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    dacs_.emplace_back(setup_.table.axis[axis].dac_bits);
    shafts_.emplace_back(setup_.table.axis[axis], plant_->encoder_position(axis));
  }
}

void PlantBench::describe(twin_segment& memory) const noexcept {
  memory.period = setup_.period;
  memory.axes = kServoAxes + 1;
  for (std::size_t i = 0; i < kServoAxes; ++i) {
    twin_axis& axis = memory.axis[i];
    name_axis(axis, i == kX ? "x" : "y", TWIN_AXIS_SERVO);
    axis.home_is_positive = setup_.home_is_positive[i] ? 1 : 0;
    axis.mm_per_count = setup_.table.axis[i].encoder.mm_per_count;
    axis.mm_per_s_per_volt = setup_.table.axis[i].mm_per_s_per_volt();
  }
  twin_axis& pen = memory.axis[kPen];
  name_axis(pen, "z", TWIN_AXIS_POSITION);
  pen.mm_per_count = kPenMmPerCount;
  pen.mm_per_s_per_volt = kPenMmPerSPerVolt;
}

bool PlantBench::is_broken(std::size_t axis, Kind kind) const noexcept {
  const auto bit = static_cast<std::size_t>(kind);
  return axes_[axis].broken.test(bit) || axes_[axis].injected.test(bit);
}

void PlantBench::break_now(const rig::emulator::Fault& fault) noexcept {
  Axis& axis = axes_[fault.axis];
  axis.broken.set(static_cast<std::size_t>(fault.kind));
  if (fault.kind == Kind::kEncoderLostCounts) {
    axis.edges_to_lose += rig::emulator::kLostCounts;
  } else if (fault.kind == Kind::kDacStuck) {
    axis.stuck_volts = axis.volts;
  } else if (fault.kind == Kind::kAlarm) {
    plant_->trip(fault.axis);
  }
}

void PlantBench::strike_due() noexcept {
  for (std::size_t i = 0; i < setup_.faults.size(); ++i) {
    const rig::emulator::Fault& fault = setup_.faults[i];
    const std::optional<double>& ready = axes_[fault.axis].first_ready;
    // Half a period of tolerance: the sum of periods is not exact.
    if (struck_[i] == 0 && ready && time() >= *ready + fault.time - 0.5 * setup_.period) {
      struck_[i] = 1;
      break_now(fault);
    }
  }
}

std::vector<rig::emulator::Fault> PlantBench::take_struck() {
  std::vector<rig::emulator::Fault> struck;
  for (std::size_t i = 0; i < struck_.size(); ++i) {
    if (struck_[i] == 1) {
      struck_[i] = 2;
      struck.push_back(setup_.faults[i]);
    }
  }
  return struck;
}

void PlantBench::take_injected(std::size_t axis, std::uint32_t faults) noexcept {
  auto& injected = axes_[axis].injected;
  for (const Injected& fault : kInjected) {
    const auto bit = static_cast<std::size_t>(fault.kind);
    const bool is_on = (faults & fault.bit) != 0;
    if (is_on && !injected.test(bit) && fault.kind == Kind::kAlarm) {
      plant_->trip(axis);
    }
    injected.set(bit, is_on);
  }
}

void PlantBench::drive(std::size_t axis, const twin_command& command) noexcept {
  Axis& state = axes_[axis];
  take_injected(axis, command.faults);
  plant_->force_limits(axis, is_broken(axis, Kind::kLimitPositive),
                       is_broken(axis, Kind::kLimitNegative));
  plant_->set_external_force(axis, std::isfinite(command.load_force) ? command.load_force : 0.0);
  state.volts = dacs_[axis].convert(std::isfinite(command.volts) ? command.volts : 0.0);
  double vref = is_broken(axis, Kind::kDacStuck) ? state.stuck_volts : state.volts;
  vref = is_broken(axis, Kind::kVrefOpen) ? 0.0 : vref;
  vref = is_broken(axis, Kind::kVrefReversed) ? -vref : vref;
  const bool is_resetting = command.fault_reset != 0;
  if (is_resetting && !state.is_resetting) {
    plant_->reset_drive(axis);
  }
  state.is_resetting = is_resetting;
  plant_->command(axis, vref, command.servo_on != 0 && !is_broken(axis, Kind::kServoOnLost));
}

void PlantBench::count(std::size_t axis) noexcept {
  Axis& state = axes_[axis];
  rig::boards::EncoderMotion motion = shafts_[axis].move_to(plant_->encoder_position(axis));
  if (is_broken(axis, Kind::kEncoderFrozen)) {
    return;
  }
  if (is_broken(axis, Kind::kEncoderSlipping)) {
    const std::int64_t before = state.edges_slipped / kSlipEvery;
    state.edges_slipped += std::abs(motion.edges);
    const std::int64_t lost = state.edges_slipped / kSlipEvery - before;
    motion.edges -= motion.edges < 0 ? -lost : lost;
  }
  motion.edges -= std::exchange(state.edges_to_lose, 0);
  if (is_broken(axis, Kind::kEncoderSwapped)) {
    motion.edges = -motion.edges;
    motion.since_index = -motion.since_index;
  }
  state.counts += motion.edges;
  if (motion.has_index) {
    ++state.index_marks;
    state.index_counts = state.counts - motion.since_index;
  }
}

bool PlantBench::advance(const twin_segment& memory) noexcept {
  strike_due();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    drive(axis, memory.axis[axis].command);
  }
  const double pen = memory.axis[kPen].command.position;
  plant_->set_pen_reference(std::isfinite(pen) ? pen : 0.0);
  if (!plant_->advance()) {
    return false;
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    count(axis);
    if (plant_->is_ready(axis) && !axes_[axis].first_ready) {
      axes_[axis].first_ready = time();
    }
  }
  return true;
}

void PlantBench::show(twin_segment& memory) const noexcept {
  for (std::size_t i = 0; i < kServoAxes; ++i) {
    twin_feedback& feedback = memory.axis[i].feedback;
    feedback.counts = axes_[i].counts;
    feedback.index_counts = axes_[i].index_counts;
    feedback.index_marks = axes_[i].index_marks;
    feedback.position =
        static_cast<double>(axes_[i].counts) * setup_.table.axis[i].encoder.mm_per_count;
    feedback.velocity = plant_->velocity(i);
    feedback.torque = plant_->torque(i);
    feedback.friction = plant_->friction(i);
    feedback.table_position = plant_->position(i);
    feedback.ready = plant_->is_ready(i) ? 1 : 0;
    feedback.alarm = plant_->has_alarm(i) || is_broken(i, Kind::kWireBroken) ? 1 : 0;
    feedback.limit_positive = plant_->is_limit_positive(i) ? 1 : 0;
    feedback.limit_negative = plant_->is_limit_negative(i) ? 1 : 0;
  }
  twin_feedback& pen = memory.axis[kPen].feedback;
  pen.position = plant_->pen_position();
  pen.counts = std::llround(pen.position / kPenMmPerCount);
  memory.time = time();
}

void PlantBench::switch_off() noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    plant_->command(axis, 0.0, false);
  }
}

}  // namespace twin::hal::linuxcnc
