#pragma once

#include <stdexcept>

namespace twin::hal::mujoco {

/// What MuJoCo would have ended the process with.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// MuJoCo calls one with the text of an error or a warning.
using MujocoHandler = void (*)(const char*);

/// Makes MuJoCo throw MujocoError instead of ending the process, and keeps its warnings off the
/// terminal and out of MUJOCO_LOG.TXT; they stay countable in mjData::warning. The handlers are
/// process wide.
/// @param user_error    mju_user_error of the loaded library
/// @param user_warning  mju_user_warning of the loaded library
void install_handlers(MujocoHandler& user_error, MujocoHandler& user_warning) noexcept;

}  // namespace twin::hal::mujoco
