#include "core/temporary_name.hpp"

#include <chrono>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace twin {
namespace {

/// The names, and the lock that goes with them. They are never destroyed, because the end of the
/// process may need them at any time.
struct Names {
  std::mutex mutex;
  std::list<std::filesystem::path> list;
};

Names& names() {
  static auto* const all = new Names;
  return *all;
}

}  // namespace

TemporaryName::TemporaryName(std::filesystem::path name) {
  std::error_code ignored;
  std::filesystem::path whole = std::filesystem::absolute(name, ignored);
  Names& all = names();
  const std::lock_guard lock(all.mutex);
  place_ = all.list.insert(all.list.end(), ignored ? std::move(name) : std::move(whole));
}

TemporaryName::TemporaryName(TemporaryName&& other) noexcept
    : place_(std::exchange(other.place_, std::nullopt)) {}

TemporaryName& TemporaryName::operator=(TemporaryName&& other) noexcept {
  std::swap(place_, other.place_);
  return *this;
}

TemporaryName::~TemporaryName() {
  if (place_) {
    const std::lock_guard lock(names().mutex);
    names().list.erase(*place_);
  }
}

void TemporaryName::remove_all() noexcept try {
  Names& all = names();
  const std::unique_lock lock(all.mutex);
  for (const std::filesystem::path& name : all.list) {
    // Other threads may still make files in a folder while it is being emptied.
    std::error_code error;
    for (int i = 0; i < 5; ++i) {
      std::filesystem::remove_all(name, error);
      if (!error) {
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
} catch (...) {  // memory may be short: what is left has a temporary name
}

}  // namespace twin
