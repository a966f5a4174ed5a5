#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "runtime/pacer.hpp"

namespace twin::test {

/// A clock that stands but for sleeps, each of which ends as late as is told.
class FakeClock final : public runtime::Clock {
 public:
  std::function<std::int64_t(std::int64_t)> lateness;  ///< [ns] of the sleep of a number from 0
  std::int64_t time = 1'000'000'000;                   ///< [ns]
  std::int64_t sleeps = 0;

  std::int64_t now() noexcept override { return time; }
  void sleep_until(std::int64_t t) noexcept override {
    time = std::max(time, t) + (lateness ? lateness(sleeps) : 0);
    ++sleeps;
  }
};

}  // namespace twin::test
