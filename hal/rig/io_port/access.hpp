#pragma once

#include <cstdint>

namespace twin::hal::rig::io_port {

/// How registers are reached.
enum class Access : std::uint8_t {
  kSysfs,   ///< resource file of the card, pread and pwrite
  kIoperm,  ///< port instructions after ioperm()
};

}  // namespace twin::hal::rig::io_port
