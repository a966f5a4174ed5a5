#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/machine.hpp"
#include "hal/rig/bench.hpp"
#include "hal/rig/cards.hpp"
#include "hal/rig/emergency.hpp"
#include "hal/rig/rig_settings.hpp"
#include "hal/rig/servopack.hpp"
#include "hal/rig/watch.hpp"

namespace twin::hal::rig {

/// Opens the cards: with the drives off and 0 V.
using CardsFactory = std::function<Expected<std::unique_ptr<Cards>>()>;

/// Scales of the simulated table, signed; used where the rig's own setting is 0.
struct TableScales {
  std::array<double, kServoAxes> mm_per_count{};       ///< encoder [mm/count]
  std::array<double, kServoAxes> mm_per_s_per_volt{};  ///< V-REF [mm/s/V]
};

/// The rig: two drives behind a PCI-1716 and a PCI-1784, real or emulated.
///
/// A period: read() lets an emulated bench go on, then latches and reads; write() writes digital
/// outputs first and the converters last. Whatever fails, the cards are made safe at once: 0 V,
/// then servo off. Volts go to the terminals as they are written, but for the trim; signs are in
/// the scales of info().
///
/// activate() lets no simulated time pass unless a drive has an alarm, which it then resets.
class RigMachine final : public Machine {
 public:
  /// @param bench  what is behind emulated cards; null: real cards
  /// @param watch  the guard over the outputs, or null; must outlive this
  RigMachine(RigSettings settings, const TableScales& table, CardsFactory open_cards,
             std::shared_ptr<Bench> bench = nullptr, Watch* watch = nullptr);
  ~RigMachine() override;

  const MachineInfo& info() const noexcept override { return info_; }
  State state() const noexcept { return state_; }
  std::optional<Error> configure(double period) override;
  std::optional<Error> activate() override;
  Status read(Inputs& inputs) noexcept override;
  Status write(const Outputs& outputs) noexcept override;
  Truth truth() const noexcept override;
  void deactivate() noexcept override;
  void cleanup() noexcept override;
  std::string last_error() const override;

  /// The open cards, for commands that look at all lines; null while unconfigured.
  Cards* cards() noexcept { return cards_.get(); }

 private:
  enum class Fault {
    kNone,
    kNotConfigured,  // read() came before configure()
    kNotActive,      // write() came before activate()
    kNotANumber,     // in the outputs
    kCards,          // a card no longer answers
    kBench,          // the simulation failed
    kGuard,          // the guard has made the outputs safe
    kGuardGone,      // nothing watches the outputs any more
  };

  Expected<void> get_ready(CardInputs& inputs);
  Expected<void> reset_alarms(CardInputs& inputs);
  Expected<void> wait(double time);
  Expected<void> wait_for_standstill(CardInputs& inputs);
  Expected<void> fetch(CardInputs& inputs);
  void fill(const CardInputs& card, Inputs& inputs) const noexcept;
  CardOutputs card_outputs(const Outputs& outputs) const noexcept;
  bool has_guard_acted() const noexcept { return watch_ != nullptr && watch_->has_acted(); }
  Status stop_with(Fault fault) noexcept;

  RigSettings settings_;
  std::vector<Servopack> drives_;
  CardsFactory open_cards_;
  std::shared_ptr<Bench> bench_;
  Watch* watch_;
  MachineInfo info_;
  State state_ = State::kUnconfigured;
  Fault fault_ = Fault::kNone;
  std::unique_ptr<Cards> cards_;
  std::optional<EmergencyStop> emergency_;
  double period_ = 0.0;                          // [s]
  std::array<std::int64_t, kServoAxes> home_{};  // of the counters, set by activate() [counts]
  std::array<bool, kServoAxes> servo_on_{};      // as last written
  Truth origin_;                                 // of truth(), set by activate() [mm]
  bool is_armed_ = false;                        // heartbeats are expected
};

}  // namespace twin::hal::rig
