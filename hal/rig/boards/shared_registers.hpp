#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "hal/machine.hpp"
#include "hal/rig/boards/board_registers.hpp"

namespace twin::hal::rig::boards {

/// The memory that the process of the emulator and that of the controller share.
struct SharedBlock {
  std::atomic<std::uint64_t> magic{0};    ///< kSharedMagic once published
  std::atomic<std::uint32_t> version{0};  ///< kSharedVersion
  std::atomic<pid_t> emulator{0};
  std::atomic<pid_t> controller{0};           ///< 0: none is attached
  std::atomic<bool> has_ended{false};         ///< the emulator has ended by itself
  std::atomic<std::int64_t> monotonic_ns{0};  ///< CLOCK_MONOTONIC up to which time has passed [ns]
  std::atomic<double> plant_time{0.0};        ///< simulated time [s]
  std::array<std::atomic<double>, kServoAxes> table_position{};  ///< true position [mm]
  std::atomic<double> pen_reference{0.0};                        ///< by the controller [mm]
  BoardRegisters boards;
};

inline constexpr std::uint64_t kSharedMagic = 0x5457494E52494731;  // "TWINRIG1"
inline constexpr std::uint32_t kSharedVersion = 1;  ///< of SharedBlock; another one is refused

/// Name of the shared memory where none is given: "/twin-rig-UID".
std::string default_shared_name();

/// What an attached process is.
enum class SharedRole : std::uint8_t {
  kController,  ///< drives the rig; one at a time, known to the emulator
  kObserver,    ///< anybody else: a guard, a probe
};

/// Registers of emulated boards in POSIX shared memory, mode 0600.
///
/// The emulator holds a lock on the memory as long as it lives, and the kernel releases the lock
/// however the emulator ends. So a new emulator can see whether the memory belongs to a living one,
/// or was left by a dead one and may be taken over.
/// If a process forks, the memory stays mapped in the child, which may use it and removes nothing.
class SharedRegisters {
 public:
  /// For the emulator: creates the memory. Nobody can attach to it before publish().
  /// @param name  "/" followed by letters
  /// @returns kMachine error if another emulator has the name or the system refuses
  static Expected<std::unique_ptr<SharedRegisters>> create(const std::string& name);
  /// For all others: attaches to the memory of an emulator.
  /// @returns kMachine error if no emulator has the name, or if the one that has it is dead, is of
  ///          another version, or has a controller already
  static Expected<std::unique_ptr<SharedRegisters>> attach(const std::string& name,
                                                           SharedRole role);
  /// The emulator marks the cards as gone and removes the memory. A controller detaches.
  ~SharedRegisters();
  SharedRegisters(const SharedRegisters&) = delete;
  SharedRegisters& operator=(const SharedRegisters&) = delete;

  /// For the emulator, once the registers are those of cards that are switched on: lets others
  /// attach.
  void publish() noexcept { block_->magic.store(kSharedMagic, std::memory_order_release); }

  SharedBlock& block() noexcept { return *block_; }
  BoardRegisters& boards() noexcept { return block_->boards; }

 private:
  SharedRegisters(std::string name, int file, SharedBlock* block, pid_t owner) noexcept;

  std::string name_;
  int file_;
  SharedBlock* block_;
  pid_t owner_;  // process that made this
  bool is_emulator_ = false;
  bool is_controller_ = false;
};

/// Whether a process is running. One that has ended but was not waited for is not. Not real-time
/// safe.
bool is_running(pid_t process) noexcept;

}  // namespace twin::hal::rig::boards
