#include "hal/rig/daqnavi_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

namespace twin::hal::rig {
namespace {

// Takes functions out of a library and remembers the first that is missing.
class Symbols {
 public:
  explicit Symbols(void* handle) : handle_(handle) {}

  template <class Function>
  void take(Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(handle_, name));
    if (function == nullptr && missing_.empty()) {
      missing_ = name;
    }
  }
  const std::string& missing() const { return missing_; }

 private:
  void* handle_;
  std::string missing_;
};

void take_all(Symbols& from, DaqnaviApi& api) {
  from.take(api.create_ao, "AdxInstantAoCtrlCreate");
  from.take(api.dispose_ao, "InstantAoCtrl_Dispose");
  from.take(api.select_ao, "InstantAoCtrl_setSelectedDevice");
  from.take(api.ao_channels, "InstantAoCtrl_getChannels");
  from.take(api.item, "ICollection_getItem");
  from.take(api.set_value_range, "AnalogChannel_setValueRange");
  from.take(api.write_ao, "InstantAoCtrl_WriteAny");
  from.take(api.create_di, "AdxInstantDiCtrlCreate");
  from.take(api.dispose_di, "InstantDiCtrl_Dispose");
  from.take(api.select_di, "InstantDiCtrl_setSelectedDevice");
  from.take(api.read_di, "InstantDiCtrl_ReadAny");
  from.take(api.create_do, "AdxInstantDoCtrlCreate");
  from.take(api.dispose_do, "InstantDoCtrl_Dispose");
  from.take(api.select_do, "InstantDoCtrl_setSelectedDevice");
  from.take(api.write_do, "InstantDoCtrl_WriteAny");
  from.take(api.create_counter, "AdxUdCounterCtrlCreate");
  from.take(api.dispose_counter, "UdCounterCtrl_Dispose");
  from.take(api.select_counter, "UdCounterCtrl_setSelectedDevice");
  from.take(api.set_counter_channel, "UdCounterCtrl_setChannel");
  from.take(api.set_counting_type, "UdCounterCtrl_setCountingType");
  from.take(api.set_counter_enabled, "UdCounterCtrl_setEnabled");
  from.take(api.counter_value, "UdCounterCtrl_getValue");
}

}  // namespace

Expected<DaqnaviLibrary> DaqnaviLibrary::load(const std::string& name) {
  void* handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return fail(ErrorCode::kMachine,
                fmt::format("cannot load Advantech's DAQNavi library: {}; install it, name it in "
                            "rig.daqnavi_library, or set rig.driver = \"registers\"",
                            ::dlerror()));
  }
  DaqnaviLibrary library;
  library.handle_ = std::shared_ptr<void>(handle, ::dlclose);
  Symbols symbols(handle);
  take_all(symbols, library.api_);
  if (!symbols.missing().empty()) {
    return fail(ErrorCode::kMachine,
                fmt::format("{} has no function {}: not the C interface of DAQNavi 3 for Linux; "
                            "set rig.driver = \"registers\"",
                            name, symbols.missing()));
  }
  return library;
}

}  // namespace twin::hal::rig
