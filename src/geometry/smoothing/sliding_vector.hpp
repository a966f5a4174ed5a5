#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace twin::geometry {

/// A sequence that grows at its end and is forgotten from its beginning; its elements keep their
/// indices. Memory and time are those of what is kept.
template <class T>
class SlidingVector {
 public:
  std::size_t begin_index() const noexcept { return base_ + dead_; }
  std::size_t end_index() const noexcept { return base_ + items_.size(); }
  std::size_t size() const noexcept { return items_.size() - dead_; }
  bool is_empty() const noexcept { return size() == 0; }

  /// The element of index i, which must have come and not been forgotten.
  T& operator[](std::size_t i) noexcept { return items_[checked(i)]; }
  const T& operator[](std::size_t i) const noexcept { return items_[checked(i)]; }
  T& front() noexcept { return items_[dead_]; }
  const T& front() const noexcept { return items_[dead_]; }
  T& back() noexcept { return items_.back(); }
  const T& back() const noexcept { return items_.back(); }

  void push_back(const T& item) { items_.push_back(item); }

  /// Drops the elements from index `end` on.
  void truncate(std::size_t end) { items_.resize(end - base_); }

  /// Forgets the elements before index `begin`.
  void drop_before(std::size_t begin) {
    if (begin <= begin_index()) {
      return;
    }
    dead_ = begin - base_;
    if (dead_ >= kLeast && 2 * dead_ >= items_.size()) {
      items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(dead_));
      base_ += dead_;
      dead_ = 0;
    }
  }

  /// Empty; the next element gets index `begin`.
  void restart(std::size_t begin) {
    items_.clear();
    base_ = begin;
    dead_ = 0;
  }

 private:
  static constexpr std::size_t kLeast = 64;  // elements worth moving the others for

  /// Place of index i in memory.
  std::size_t checked(std::size_t i) const noexcept {
    assert(i - base_ < items_.size());
    return i - base_;
  }

  std::vector<T> items_;
  std::size_t dead_ = 0;  // forgotten elements that are still in memory
  std::size_t base_ = 0;  // index of items_[0]
};

}  // namespace twin::geometry
