#pragma once

#include <unistd.h>

#include <utility>

namespace twin {

/// A file descriptor that is closed at the end; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) noexcept : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) {
      ::close(value_);
    }
  }

  int get() const noexcept { return value_; }
  /// Leaves it open, to the caller.
  int release() noexcept { return std::exchange(value_, -1); }

 private:
  int value_;
};

}  // namespace twin
