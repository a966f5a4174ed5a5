#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What the stand-in for libbiodaq keeps: the calls it got and the card it pretends to be.
struct StandIn {
  std::vector<std::string> calls;  ///< function names, in order
  bool is_recording = true;
  std::string failing;              ///< function that fails, empty: none
  std::uint32_t code = 0xE0000015;  ///< with which code: ErrorDeviceNotExist
  std::string description;          ///< of the device selected last
  std::int32_t mode = -1;           ///< access mode of that
  std::int32_t range[2] = {};
  double volts[2] = {99.0, 99.0};
  std::uint8_t digital_out[2] = {};
  std::uint8_t digital_in[2] = {};
  std::int32_t count[4] = {};
  std::int32_t counting_type[4] = {};
  bool is_counting[4] = {};
  int objects = 0;  ///< created and not disposed of
};

/// Exported by the stand-in as "stand_in": its state.
using StandInState = StandIn* (*)();
