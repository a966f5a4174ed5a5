#pragma once

#include <stdexcept>

namespace twin::hal::mujoco {

/// What MuJoCo would have ended the process with.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Makes MuJoCo throw MujocoError instead of ending the process, and keeps its warnings off the
/// terminal and out of MUJOCO_LOG.TXT; they stay countable in mjData::warning. The handlers are
/// process wide; installing them again is free.
void install_mujoco_handlers() noexcept;

}  // namespace twin::hal::mujoco
