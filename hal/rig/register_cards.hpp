#pragma once

#include <memory>

#include "hal/rig/cards.hpp"
#include "hal/rig/io_port/find_card.hpp"
#include "hal/rig/pci1716.hpp"
#include "hal/rig/pci1784.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// The cards, driven by their registers over two ports: of real cards or of emulated boards.
class RegisterCards final : public Cards {
 public:
  /// Opens both cards: drives off and 0 V, then the counters.
  ///
  /// @returns a kMachine error where a card does not answer; what answered is left safe
  static Expected<std::unique_ptr<Cards>> open(std::unique_ptr<io_port::IoPort> pci1716,
                                               std::unique_ptr<io_port::IoPort> pci1784,
                                               const RigSettings& settings);
  /// 0 V and drives off.
  ~RegisterCards() override;

  Status read(CardInputs& inputs) noexcept override;
  Status write(const CardOutputs& outputs) noexcept override;
  void make_safe() noexcept override { analogue_.make_safe(); }
  std::string last_error() const override;

  /// The card itself, for what the cycle does not need: analogue inputs. Not while it runs.
  Pci1716& pci1716() noexcept { return analogue_; }

 private:
  enum class Fault { kNone, kPci1716Gone, kPci1784Gone, kPci1716Port, kPci1784Port };

  RegisterCards(std::unique_ptr<io_port::IoPort> pci1716, std::unique_ptr<io_port::IoPort> pci1784,
                const RigSettings& settings);
  Status check_ports() noexcept;
  Status fail_with(Fault fault) noexcept;

  std::unique_ptr<io_port::IoPort> port_1716_;
  std::unique_ptr<io_port::IoPort> port_1784_;
  Pci1716 analogue_;
  Pci1784 counters_;
  Fault fault_ = Fault::kNone;
};

/// Where both cards of the rig are.
struct CardsFound {
  io_port::CardSeen pci1716;
  io_port::CardSeen pci1784;
};

/// Looks for both cards as the settings describe them; the error names the first that is missing.
Expected<CardsFound> find_cards(const RigSettings& settings);

/// Finds both cards and opens them.
Expected<std::unique_ptr<Cards>> open_register_cards(const RigSettings& settings);

}  // namespace twin::hal::rig
