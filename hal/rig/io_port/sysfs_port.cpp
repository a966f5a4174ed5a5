#include "hal/rig/io_port/sysfs_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

namespace twin::hal::rig::io_port {
namespace {

// One access of exactly sizeof(T) bytes: a short one is no access at all.
template <class T>
T read_register(int descriptor, std::uint32_t offset, PortError& error) noexcept {
  const int before = errno;  // this may run in a signal handler
  T value = 0;
  const ssize_t done = ::pread(descriptor, &value, sizeof value, offset);
  if (done != static_cast<ssize_t>(sizeof value)) {
    error.note(done < 0 ? errno : EIO);
    value = std::numeric_limits<T>::max();
  }
  errno = before;
  return value;
}

template <class T>
void write_register(int descriptor, std::uint32_t offset, T value, PortError& error) noexcept {
  const int before = errno;
  const ssize_t done = ::pwrite(descriptor, &value, sizeof value, offset);
  if (done != static_cast<ssize_t>(sizeof value)) {
    error.note(done < 0 ? errno : EIO);
  }
  errno = before;
}

}  // namespace

Expected<std::unique_ptr<SysfsPort>> SysfsPort::open(const std::string& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor >= 0) {
    return std::unique_ptr<SysfsPort>(new SysfsPort(descriptor));
  }
  if (errno == EACCES || errno == EPERM) {
    return fail(ErrorCode::kMachine,
                fmt::format("no permission to open {}: run as root, or give this user read and "
                            "write permission on it",
                            file));
  }
  return fail(ErrorCode::kMachine, fmt::format("cannot open {}: {}", file, std::strerror(errno)));
}

SysfsPort::~SysfsPort() { ::close(descriptor_); }

std::uint8_t SysfsPort::read8(std::uint32_t offset) noexcept {
  return read_register<std::uint8_t>(descriptor_, offset, error_);
}
std::uint16_t SysfsPort::read16(std::uint32_t offset) noexcept {
  return read_register<std::uint16_t>(descriptor_, offset, error_);
}
std::uint32_t SysfsPort::read32(std::uint32_t offset) noexcept {
  return read_register<std::uint32_t>(descriptor_, offset, error_);
}
void SysfsPort::write8(std::uint32_t offset, std::uint8_t value) noexcept {
  write_register(descriptor_, offset, value, error_);
}
void SysfsPort::write16(std::uint32_t offset, std::uint16_t value) noexcept {
  write_register(descriptor_, offset, value, error_);
}
void SysfsPort::write32(std::uint32_t offset, std::uint32_t value) noexcept {
  write_register(descriptor_, offset, value, error_);
}

}  // namespace twin::hal::rig::io_port
