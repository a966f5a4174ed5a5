#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "hal/linuxcnc/segment.h"

namespace twin::hal::linuxcnc {

/// What this program is to the HAL component at the other side of the memory.
enum class Role : std::uint8_t {
  kPlant,       ///< answers drive commands with feedback; makes the memory
  kController,  ///< answers feedback with drive commands; the component made the memory
};

/// User that the memory belongs to. LinuxCNC's real-time process refuses to run as root and takes
/// the user of RTAPI_UID instead, so a root whose environment has it gives the memory to that user.
uid_t segment_owner() noexcept;

/// Name of the memory where none is given: "/twin-plant-UID" or "/twin-controller-UID".
std::string default_segment_name(Role role);

/// The memory that this program shares with a component of LinuxCNC's HAL, as segment.h has it.
///
/// It is a file of mode 0600 in /dev/shm. Each side locks a byte of it as long as it lives, so that
/// a side that was killed is missed at once, and what it left is taken over.
class SharedSegment {
 public:
  /// Makes the memory of a plant, or takes over what an earlier one has left. A component that is
  /// still attached to that goes on with the new plant.
  /// @returns kMachine error if another plant uses it, or it belongs to another user or version
  static Expected<std::unique_ptr<SharedSegment>> make_plant(const std::string& name);
  /// Attaches the controller to the memory that the component `twinctl` has made.
  /// @returns kMachine error if there is none, or it has a controller, another owner or version
  static Expected<std::unique_ptr<SharedSegment>> attach_controller(const std::string& name);
  /// A plant removes the memory unless a component is attached.
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  twin_segment& memory() noexcept { return *segment_; }
  const twin_segment& memory() const noexcept { return *segment_; }
  const std::string& name() const noexcept { return name_; }

  /// Lets the component see the memory of a plant, once axes and period are in it.
  void publish() noexcept;
  /// Whether a component is attached. Real-time safe.
  bool has_shim() const noexcept;
  /// Waits for a question, at most for a while. Real-time safe. @param patience [ns]
  /// @returns whether one waits for its answer
  bool wait_for_question(std::int64_t patience) noexcept;
  /// Answers the question that waits. Real-time safe.
  void answer() noexcept;
  /// Drops a question that was put to a program before this one.
  void drop_question() noexcept;

 private:
  SharedSegment(std::string name, int file, twin_segment* segment, Role role) noexcept;
  static Expected<std::unique_ptr<SharedSegment>> map(const std::string& name, int file, Role role);

  std::string name_;
  int file_;
  twin_segment* segment_;
  Role role_;
};

}  // namespace twin::hal::linuxcnc
