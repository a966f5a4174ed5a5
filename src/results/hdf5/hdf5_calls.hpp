#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

#include "core/error.hpp"

/// Traces in HDF5 files, on the C library.
namespace twin::results::hdf5 {

/// Held while the library is called: it need not have been built for several threads. Its messages
/// are kept from standard error as long.
class Calls {
 public:
  Calls();
  ~Calls();
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t report_ = nullptr;  // what the library did with messages before
  void* data_ = nullptr;
};

/// "cannot ACTION: WHAT THE LIBRARY SAYS", about a file. The library's words are those of the call
/// that failed last in this thread.
tl::unexpected<Error> library_error(const std::string& file, const char* action);

/// An object of the library, closed at the end of its life. Calls must be held then.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close_by)(hid_t)) : id_(id), close_(close_by) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { static_cast<void>(close()); }

  hid_t id() const noexcept { return id_; }
  bool is_open() const noexcept { return id_ >= 0; }
  /// @returns false if the library says that it failed
  bool close() noexcept { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// How files are opened: in the oldest format, which every reader knows, without locks.
Handle file_access();

}  // namespace twin::results::hdf5
