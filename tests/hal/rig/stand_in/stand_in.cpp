#include "stand_in.hpp"

// A stand-in for Advantech's library: the same C functions, with declarations of its own.
namespace {

struct DeviceInformation {
  std::int32_t number;
  std::int32_t mode;
  std::int32_t module;
  wchar_t description[64];
};

struct Object {
  int channel = 0;  // of a counter
};

StandIn state;
Object channels[2];  // of the converter

std::uint32_t called(const char* name) {
  if (state.is_recording) {
    state.calls.emplace_back(name);
  }
  return state.failing == name ? state.code : 0;
}

void* create(const char* name) {
  if (called(name) != 0) {
    return nullptr;
  }
  ++state.objects;
  return new Object;
}

void dispose(const char* name, void* object) {
  called(name);
  --state.objects;
  delete static_cast<Object*>(object);
}

std::uint32_t select(const char* name, const DeviceInformation* device) {
  state.description.clear();
  for (const wchar_t* c = device->description; *c != 0; ++c) {
    state.description += static_cast<char>(*c);
  }
  state.mode = device->mode;
  return called(name);
}

int channel_of(void* object) { return static_cast<Object*>(object)->channel; }

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

EXPORT StandIn* stand_in() { return &state; }

EXPORT void* AdxInstantAoCtrlCreate() { return create(__func__); }
EXPORT void InstantAoCtrl_Dispose(void* o) { dispose(__func__, o); }
EXPORT std::uint32_t InstantAoCtrl_setSelectedDevice(void*, const DeviceInformation* d) {
  return select(__func__, d);
}
EXPORT void* InstantAoCtrl_getChannels(void*) { return called(__func__) == 0 ? channels : nullptr; }
EXPORT void* ICollection_getItem(void* collection, std::int32_t i) {
  return called(__func__) == 0 ? static_cast<Object*>(collection) + i : nullptr;
}
EXPORT std::uint32_t AnalogChannel_setValueRange(void* channel, std::int32_t range) {
  state.range[static_cast<Object*>(channel) - channels] = range;
  return called(__func__);
}
EXPORT std::uint32_t InstantAoCtrl_WriteAny(void*, std::int32_t start, std::int32_t count, void*,
                                            double* volts) {
  const std::uint32_t code = called(__func__);
  for (std::int32_t i = 0; i < count && code == 0; ++i) {
    state.volts[start + i] = volts[i];
  }
  return code;
}

EXPORT void* AdxInstantDiCtrlCreate() { return create(__func__); }
EXPORT void InstantDiCtrl_Dispose(void* o) { dispose(__func__, o); }
EXPORT std::uint32_t InstantDiCtrl_setSelectedDevice(void*, const DeviceInformation* d) {
  return select(__func__, d);
}
EXPORT std::uint32_t InstantDiCtrl_ReadAny(void*, std::int32_t start, std::int32_t count,
                                           std::uint8_t* data) {
  for (std::int32_t i = 0; i < count; ++i) {
    data[i] = state.digital_in[start + i];
  }
  return called(__func__);
}

EXPORT void* AdxInstantDoCtrlCreate() { return create(__func__); }
EXPORT void InstantDoCtrl_Dispose(void* o) { dispose(__func__, o); }
EXPORT std::uint32_t InstantDoCtrl_setSelectedDevice(void*, const DeviceInformation* d) {
  return select(__func__, d);
}
EXPORT std::uint32_t InstantDoCtrl_WriteAny(void*, std::int32_t start, std::int32_t count,
                                            std::uint8_t* data) {
  const std::uint32_t code = called(__func__);
  for (std::int32_t i = 0; i < count && code == 0; ++i) {
    state.digital_out[start + i] = data[i];
  }
  return code;
}

EXPORT void* AdxUdCounterCtrlCreate() { return create(__func__); }
EXPORT void UdCounterCtrl_Dispose(void* o) { dispose(__func__, o); }
EXPORT std::uint32_t UdCounterCtrl_setSelectedDevice(void*, const DeviceInformation* d) {
  return select(__func__, d);
}
EXPORT std::uint32_t UdCounterCtrl_setChannel(void* o, std::int32_t channel) {
  static_cast<Object*>(o)->channel = channel;
  return called(__func__);
}
EXPORT std::uint32_t UdCounterCtrl_setCountingType(void* o, std::int32_t type) {
  state.counting_type[channel_of(o)] = type;
  return called(__func__);
}
EXPORT std::uint32_t UdCounterCtrl_setEnabled(void* o, std::int8_t enabled) {
  state.is_counting[channel_of(o)] = enabled != 0;
  return called(__func__);
}
#ifndef WITHOUT_COUNTER_VALUE
EXPORT std::int32_t UdCounterCtrl_getValue(void* o) {
  called(__func__);
  return state.count[channel_of(o)];
}
#endif
