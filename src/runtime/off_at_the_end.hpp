#pragma once

#include "runtime/cycle.hpp"

namespace twin::runtime {

/// Leaves the machine with 0 V and servo off, also when a hook throws.
class OffAtTheEnd {
 public:
  explicit OffAtTheEnd(Cycle& cycle) : cycle_(cycle) {}
  OffAtTheEnd(const OffAtTheEnd&) = delete;
  OffAtTheEnd& operator=(const OffAtTheEnd&) = delete;
  ~OffAtTheEnd() { cycle_.switch_off(); }

 private:
  Cycle& cycle_;
};

}  // namespace twin::runtime
