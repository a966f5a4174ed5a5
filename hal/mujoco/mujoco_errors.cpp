#include "hal/mujoco/mujoco_errors.hpp"

#include <mujoco/mujoco.h>

#include <mutex>

namespace twin::hal::mujoco {
namespace {

void throw_error(const char* text) { throw MujocoError(text); }
void ignore_warning(const char* /*text*/) {}

}  // namespace

void install_mujoco_handlers() noexcept {
  static std::once_flag installed;
  std::call_once(installed, [] {
    mju_user_error = throw_error;
    mju_user_warning = ignore_warning;
  });
}

}  // namespace twin::hal::mujoco
