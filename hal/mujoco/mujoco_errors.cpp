#include "hal/mujoco/mujoco_errors.hpp"

namespace twin::hal::mujoco {
namespace {

void throw_error(const char* text) { throw MujocoError(text); }
void ignore_warning(const char* /*text*/) {}

}  // namespace

void install_handlers(MujocoHandler& user_error, MujocoHandler& user_warning) noexcept {
  user_error = throw_error;
  user_warning = ignore_warning;
}

}  // namespace twin::hal::mujoco
