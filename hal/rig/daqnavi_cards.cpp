#include "hal/rig/daqnavi_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {
namespace {

constexpr double kHighest = 10.0 - 20.0 / 65536.0;  // of the converter [V]

DaqnaviApi::DeviceInformation device(std::string_view name, int board_id) {
  DaqnaviApi::DeviceInformation information;
  const std::string text = fmt::format("{},BID#{}", name, board_id);
  std::copy(text.begin(), text.end(), information.description);
  return information;
}

tl::unexpected<Error> refused(std::string_view call, std::string_view card, int board_id,
                              DaqnaviApi::ErrorCode code) {
  return fail(ErrorCode::kMachine, fmt::format("DAQNavi: {} of {},BID#{} failed with {:#010x}",
                                               call, card, board_id, code));
}

}  // namespace

DaqnaviCards::DaqnaviCards(DaqnaviLibrary library, std::uint16_t safe_digital)
    : library_(std::move(library)), safe_digital_(safe_digital) {}

Expected<std::unique_ptr<Cards>> DaqnaviCards::open(const RigSettings& settings) {
  TWIN_TRY(DaqnaviLibrary library, DaqnaviLibrary::load(settings.daqnavi_library));
  std::unique_ptr<DaqnaviCards> cards(new DaqnaviCards(std::move(library), safe_digital(settings)));
  TWIN_CHECK(cards->open_outputs(settings.pci1716_board_id));
  TWIN_CHECK(cards->open_inputs(settings));
  TWIN_CHECK(cards->open_counters(settings));
  return std::unique_ptr<Cards>(std::move(cards));
}

Expected<std::unique_ptr<Cards>> DaqnaviCards::open_outputs_only(const std::string& library,
                                                                 int board_id,
                                                                 std::uint16_t safe_digital) {
  TWIN_TRY(DaqnaviLibrary loaded, DaqnaviLibrary::load(library));
  std::unique_ptr<DaqnaviCards> cards(new DaqnaviCards(std::move(loaded), safe_digital));
  TWIN_CHECK(cards->open_outputs(board_id));
  return std::unique_ptr<Cards>(std::move(cards));
}

// Drives off before the converters are touched.
Expected<void> DaqnaviCards::open_outputs(int board_id) {
  const auto card = device("PCI-1716", board_id);
  const auto refuse = [&](const char* call, Api::ErrorCode code) {
    return refused(call, "PCI-1716", board_id, code);
  };
  digital_out_ = api_.create_do();
  analogue_out_ = api_.create_ao();
  if (digital_out_ == nullptr || analogue_out_ == nullptr) {
    return refuse("creating the outputs", 0);
  }
  if (const auto code = api_.select_do(digital_out_, &card); Api::has_failed(code)) {
    return refuse("InstantDoCtrl_setSelectedDevice", code);
  }
  if (!write_digital(safe_digital_)) {
    return refuse(failed_call_, failed_code_);
  }
  if (const auto code = api_.select_ao(analogue_out_, &card); Api::has_failed(code)) {
    return refuse("InstantAoCtrl_setSelectedDevice", code);
  }
  const Api::Object channels = api_.ao_channels(analogue_out_);
  for (std::size_t i = 0; i < kDacs; ++i) {
    const Api::Object channel =
        channels == nullptr ? nullptr : api_.item(channels, static_cast<std::int32_t>(i));
    if (channel == nullptr) {
      return refuse("InstantAoCtrl_getChannels", 0);
    }
    if (const auto code = api_.set_value_range(channel, Api::kPlusMinus10V);
        Api::has_failed(code)) {
      return refuse("AnalogChannel_setValueRange", code);
    }
  }
  return write_volts({}) ? Expected<void>{} : refuse(failed_call_, failed_code_);
}

Expected<void> DaqnaviCards::open_inputs(const RigSettings& settings) {
  const auto card = device("PCI-1716", settings.pci1716_board_id);
  digital_in_ = api_.create_di();
  const auto code = digital_in_ == nullptr ? 0xE0000000u : api_.select_di(digital_in_, &card);
  if (Api::has_failed(code)) {
    return refused("InstantDiCtrl_setSelectedDevice", "PCI-1716", settings.pci1716_board_id, code);
  }
  return {};
}

Expected<void> DaqnaviCards::open_counters(const RigSettings& settings) {
  const auto card = device("PCI-1784", settings.pci1784_board_id);
  for (const AxisWiring& axis : settings.axis) {
    const auto i = static_cast<std::size_t>(axis.counter);
    const auto refuse = [&](const char* call, Api::ErrorCode code) {
      return refused(call, "PCI-1784", settings.pci1784_board_id, code);
    };
    const Api::Object counter = counters_[i] = api_.create_counter();
    if (counter == nullptr) {
      return refuse("AdxUdCounterCtrlCreate", 0);
    }
    if (const auto code = api_.select_counter(counter, &card); Api::has_failed(code)) {
      return refuse("UdCounterCtrl_setSelectedDevice", code);
    }
    if (const auto code = api_.set_counter_channel(counter, axis.counter); Api::has_failed(code)) {
      return refuse("UdCounterCtrl_setChannel", code);
    }
    if (const auto code = api_.set_counting_type(counter, Api::kAbPhaseX4); Api::has_failed(code)) {
      return refuse("UdCounterCtrl_setCountingType", code);
    }
    if (const auto code = api_.set_counter_enabled(counter, 1); Api::has_failed(code)) {
      return refuse("UdCounterCtrl_setEnabled", code);
    }
    last_[i] = api_.counter_value(counter);
  }
  return {};
}

DaqnaviCards::~DaqnaviCards() {
  make_safe();
  if (analogue_out_ != nullptr) {
    api_.dispose_ao(analogue_out_);
  }
  if (digital_out_ != nullptr) {
    api_.dispose_do(digital_out_);
  }
  if (digital_in_ != nullptr) {
    api_.dispose_di(digital_in_);
  }
  for (const Api::Object counter : counters_) {
    if (counter != nullptr) {
      api_.dispose_counter(counter);
    }
  }
}

bool DaqnaviCards::note(const char* call, Api::ErrorCode code) noexcept {
  if (!Api::has_failed(code)) {
    return true;
  }
  failed_call_ = call;
  failed_code_ = code;
  return false;
}

bool DaqnaviCards::write_digital(std::uint16_t levels) noexcept {
  std::uint8_t ports[] = {static_cast<std::uint8_t>(levels & 0xFF),
                          static_cast<std::uint8_t>(levels >> 8)};
  return note("InstantDoCtrl_WriteAny", api_.write_do(digital_out_, 0, 2, ports));
}

bool DaqnaviCards::write_volts(std::array<double, kDacs> volts) noexcept {
  for (double& value : volts) {
    value = std::isfinite(value) ? std::clamp(value, -10.0, kHighest) : 0.0;
  }
  return note("InstantAoCtrl_WriteAny",
              api_.write_ao(analogue_out_, 0, static_cast<std::int32_t>(volts.size()), nullptr,
                            volts.data()));
}

Status DaqnaviCards::read(CardInputs& inputs) noexcept {
  for (std::size_t i = 0; i < kCounters; ++i) {
    if (counters_[i] != nullptr) {
      const std::int32_t value = api_.counter_value(counters_[i]);
      path_[i] += static_cast<std::int32_t>(static_cast<std::uint32_t>(value) -
                                            static_cast<std::uint32_t>(last_[i]));
      last_[i] = value;
    }
  }
  std::uint8_t ports[2] = {};
  const bool ok = note("InstantDiCtrl_ReadAny", api_.read_di(digital_in_, 0, 2, ports));
  inputs.counts = path_;
  inputs.digital = static_cast<std::uint16_t>(ports[0] | ports[1] << 8);
  inputs.index_seen = 0;
  return ok ? Status::kOk : Status::kError;
}

Status DaqnaviCards::write(const CardOutputs& outputs) noexcept {
  const bool digital = write_digital(outputs.digital);
  return write_volts(outputs.volts) && digital ? Status::kOk : Status::kError;
}

void DaqnaviCards::make_safe() noexcept {
  if (analogue_out_ != nullptr) {
    write_volts({});
  }
  if (digital_out_ != nullptr) {
    write_digital(safe_digital_);
  }
}

std::string DaqnaviCards::last_error() const {
  return failed_call_ == nullptr
             ? std::string()
             : fmt::format("the PCI-1716 no longer answers: DAQNavi's {} failed with {:#010x}",
                           failed_call_, failed_code_);
}

}  // namespace twin::hal::rig
