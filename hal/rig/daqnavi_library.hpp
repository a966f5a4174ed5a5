#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/error.hpp"

namespace twin::hal::rig {

/// What is used of the plain C interface of Advantech's DAQNavi library for Linux (libbiodaq),
/// release 3: `bdaqctrl.h` with _BDAQ_C_INTERFACE. Objects are opaque pointers, results are error
/// codes: 0 is success, from 0xE0000000 on it is a failure, what lies between is a warning.
struct DaqnaviApi {
  using ErrorCode = std::uint32_t;
  using Object = void*;

  /// Which card, and with which rights.
  struct DeviceInformation {
    std::int32_t device_number = -1;  ///< -1: by description
    std::int32_t device_mode = 3;     ///< write, shared with the guard; the card is not reset
    std::int32_t module_index = 0;
    wchar_t description[64] = {};  ///< "PCI-1716,BID#0"
  };

  using Create = Object (*)();
  using Dispose = void (*)(Object);
  using SelectDevice = ErrorCode (*)(Object, const DeviceInformation*);
  using SetInt = ErrorCode (*)(Object, std::int32_t);
  using SetBool = ErrorCode (*)(Object, std::int8_t);
  using Ports = ErrorCode (*)(Object, std::int32_t start, std::int32_t count, std::uint8_t* data);

  Create create_ao = nullptr;
  Dispose dispose_ao = nullptr;
  SelectDevice select_ao = nullptr;
  Object (*ao_channels)(Object) = nullptr;
  Object (*item)(Object collection, std::int32_t index) = nullptr;
  SetInt set_value_range = nullptr;
  ErrorCode (*write_ao)(Object, std::int32_t start, std::int32_t count, void* raw,
                        double* volts) = nullptr;

  Create create_di = nullptr;
  Dispose dispose_di = nullptr;
  SelectDevice select_di = nullptr;
  Ports read_di = nullptr;

  Create create_do = nullptr;
  Dispose dispose_do = nullptr;
  SelectDevice select_do = nullptr;
  Ports write_do = nullptr;

  Create create_counter = nullptr;
  Dispose dispose_counter = nullptr;
  SelectDevice select_counter = nullptr;
  SetInt set_counter_channel = nullptr;
  SetInt set_counting_type = nullptr;
  SetBool set_counter_enabled = nullptr;
  std::int32_t (*counter_value)(Object) = nullptr;

  static constexpr std::int32_t kPlusMinus10V = 1;  ///< ValueRange V_Neg10To10
  static constexpr std::int32_t kAbPhaseX4 = 7;     ///< SignalCountingType AbPhaseX4

  /// True for failures; warnings are none.
  static constexpr bool has_failed(ErrorCode code) { return code >= 0xE0000000u; }
};

/// The library, loaded as long as this lives.
class DaqnaviLibrary {
 public:
  /// @param name  file name, looked for as the dynamic linker does, or path
  /// @returns a kMachine error of one line that names the library or symbol that is missing
  static Expected<DaqnaviLibrary> load(const std::string& name);

  const DaqnaviApi& api() const noexcept { return api_; }

 private:
  std::shared_ptr<void> handle_;
  DaqnaviApi api_;
};

}  // namespace twin::hal::rig
