#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/rig/io_port/io_port.hpp"

namespace twin::test {

/// One access to a register.
struct Access {
  char kind = 'w';  ///< 'r' or 'w'
  std::uint32_t offset = 0;
  int bits = 0;
  std::uint32_t value = 0;

  bool operator==(const Access&) const = default;
};

inline Access wrote(std::uint32_t offset, int bits, std::uint32_t value) {
  return {'w', offset, bits, value};
}

/// A port that records what is written and answers reads from a table. Recording allocates.
class FakePort final : public hal::rig::io_port::IoPort {
 public:
  std::map<std::uint32_t, std::uint32_t> answers;  ///< what a read at an offset gives; else 0
  std::function<void(const Access&)> on_write;     ///< told of each write, may be empty
  std::vector<Access> log;
  bool is_recording = true;
  bool is_gone = false;  ///< every read gives all ones
  int errno_value = 0;

  std::vector<Access> writes() const {
    std::vector<Access> list;
    for (const Access& access : log) {
      if (access.kind == 'w') {
        list.push_back(access);
      }
    }
    return list;
  }
  /// The last value written to an offset, or -1.
  std::int64_t last(std::uint32_t offset) const {
    std::int64_t value = -1;
    for (const Access& access : writes()) {
      value = access.offset == offset ? access.value : value;
    }
    return value;
  }

  std::uint8_t read8(std::uint32_t o) noexcept override {
    return static_cast<std::uint8_t>(read(o, 8));
  }
  std::uint16_t read16(std::uint32_t o) noexcept override {
    return static_cast<std::uint16_t>(read(o, 16));
  }
  std::uint32_t read32(std::uint32_t o) noexcept override { return read(o, 32); }
  void write8(std::uint32_t o, std::uint8_t v) noexcept override { write(o, 8, v); }
  void write16(std::uint32_t o, std::uint16_t v) noexcept override { write(o, 16, v); }
  void write32(std::uint32_t o, std::uint32_t v) noexcept override { write(o, 32, v); }
  int error() const noexcept override { return errno_value; }

 private:
  std::uint32_t read(std::uint32_t offset, int bits) noexcept {
    const auto answer = answers.find(offset);
    const std::uint32_t value =
        is_gone ? 0xFFFFFFFF : (answer == answers.end() ? 0 : answer->second);
    if (is_recording) {
      log.push_back({'r', offset, bits, value});
    }
    return value;
  }
  void write(std::uint32_t offset, int bits, std::uint32_t value) noexcept {
    if (is_recording) {
      log.push_back({'w', offset, bits, value});
    }
    if (on_write) {
      on_write({'w', offset, bits, value});
    }
  }
};

}  // namespace twin::test
