#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>

#include "hal/linuxcnc/segment.h"
#include "hal/linuxcnc/shared_segment.hpp"
#include "tests/fuzz/target.hpp"

// What lies in /dev/shm under the name of `twin plant`, from whoever left it there.
namespace twin::fuzz {
namespace segment_target {

using hal::linuxcnc::SharedSegment;

/// By the first byte a memory of the right size and kind, or the bytes alone.
void run(Bytes bytes) {
  static const std::string name = fmt::format("/twin-fuzz-{}", ::getpid());
  const unsigned kind = bytes.empty() ? 0 : bytes.front();
  bytes = bytes.empty() ? bytes : bytes.subspan(1);
  ::shm_unlink(name.c_str());
  const int file = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  promise(file >= 0, "no shared memory");
  std::size_t written =
      static_cast<std::size_t>(::write(file, bytes.data(), bytes.size()) > 0 ? bytes.size() : 0);
  if ((kind & 1U) != 0) {
    twin_segment memory;
    std::memset(&memory, 0, sizeof memory);
    std::memcpy(&memory, bytes.data(), std::min(bytes.size(), sizeof memory));
    memory.magic = TWIN_SEGMENT_MAGIC;
    memory.version = TWIN_SEGMENT_VERSION;
    memory.size = sizeof memory;
    memory.use = (kind & 2U) != 0 ? TWIN_USE_PLANT : TWIN_USE_CONTROLLER;
    written = static_cast<std::size_t>(::pwrite(file, &memory, sizeof memory, 0));
    promise(written == sizeof memory, "no room in shared memory");
  }
  ::close(file);
  if ((kind & 4U) != 0) {
    const auto plant = SharedSegment::make_plant(name);
    promise(plant || !plant.error().message.empty(), "an error of a plant without a message");
  } else {
    const auto controller = SharedSegment::attach_controller(name);
    promise(controller || !controller.error().message.empty(),
            "an error of a controller without a message");
  }
  ::shm_unlink(name.c_str());
}

}  // namespace segment_target

const Target kSegment{"segment", segment_target::run};

}  // namespace twin::fuzz
