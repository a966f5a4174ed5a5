#pragma once

#include <array>
#include <memory>
#include <string>

#include "hal/rig/cards.hpp"
#include "hal/rig/daqnavi_library.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// The cards through Advantech's DAQNavi library, for machines where its kernel driver has them.
///
/// What it cannot do as RegisterCards does: counters are read one after the other, not latched
/// together; index marks are not seen; reading a counter has no error code, so a card that is gone
/// shows as a failing digital input (PCI-1716) or as a counter that stands still (PCI-1784).
/// Whether the library's calls are safe in a signal handler is not known.
class DaqnaviCards final : public Cards {
 public:
  /// Loads the library and opens both cards by "PCI-1716,BID#n" and "PCI-1784,BID#n": drives off,
  /// +-10 V, 0 V, counters on. The error names the call, the card and DAQNavi's code.
  static Expected<std::unique_ptr<Cards>> open(const RigSettings& settings);
  /// Opens the outputs of the PCI-1716 alone, for whoever only makes them safe: read() fails.
  static Expected<std::unique_ptr<Cards>> open_outputs_only(const std::string& library,
                                                            int board_id,
                                                            std::uint16_t safe_digital);
  /// 0 V and drives off.
  ~DaqnaviCards() override;

  Status read(CardInputs& inputs) noexcept override;
  Status write(const CardOutputs& outputs) noexcept override;
  void make_safe() noexcept override;
  std::string last_error() const override;

 private:
  using Api = DaqnaviApi;

  DaqnaviCards(DaqnaviLibrary library, std::uint16_t safe_digital);
  Expected<void> open_outputs(int board_id);
  Expected<void> open_inputs(const RigSettings& settings);
  Expected<void> open_counters(const RigSettings& settings);
  bool write_digital(std::uint16_t levels) noexcept;
  bool write_volts(std::array<double, kDacs> volts) noexcept;
  bool note(const char* call, Api::ErrorCode code) noexcept;

  DaqnaviLibrary library_;
  const Api& api_ = library_.api();
  std::uint16_t safe_digital_;
  Api::Object analogue_out_ = nullptr;
  Api::Object digital_in_ = nullptr;
  Api::Object digital_out_ = nullptr;
  std::array<Api::Object, kCounters> counters_{};  // null where no axis uses it
  std::array<std::int32_t, kCounters> last_{};     // [counts]
  std::array<std::int64_t, kCounters> path_{};     // unwrapped [counts]
  const char* failed_call_ = nullptr;              // the last that failed
  Api::ErrorCode failed_code_ = 0;
};

}  // namespace twin::hal::rig
