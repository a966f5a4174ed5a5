#pragma once

#include <mujoco/mujoco.h>

#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace twin::hal::mujoco {

/// What MuJoCo would have ended the process with.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The functions of libmujoco that this room calls, each under its name without the prefix.
///
/// The library is loaded when a model is first read: a program that reads none starts without it.
/// It then stays loaded until the process ends. Whatever else in the process links libmujoco shares
/// it.
class MujocoLibrary {
 public:
  /// Loads the library at the first call; a later call returns what the first one did. From then
  /// on MuJoCo throws MujocoError instead of ending the process. Its warnings stay off the terminal
  /// and out of MUJOCO_LOG.TXT; they are countable in mjData::warning. Not real-time safe.
  /// @returns a kModel error where the library or a function of it is missing, or where its version
  /// is not that of the headers
  static Expected<const MujocoLibrary*> load();
  /// The library, once load() has succeeded. Real-time safe.
  static const MujocoLibrary& loaded() noexcept;

  /// What load() does at its first call, for a library by its name or path.
  static Expected<MujocoLibrary> open(const std::string& file);

  decltype(&::mj_loadXML) load_xml = nullptr;
  decltype(&::mj_copyModel) copy_model = nullptr;
  decltype(&::mj_deleteModel) delete_model = nullptr;
  decltype(&::mj_makeData) make_data = nullptr;
  decltype(&::mj_deleteData) delete_data = nullptr;
  decltype(&::mj_name2id) name_to_id = nullptr;
  decltype(&::mj_setConst) set_const = nullptr;
  decltype(&::mj_resetData) reset_data = nullptr;
  decltype(&::mj_step) step = nullptr;

 private:
  MujocoLibrary() = default;
};

}  // namespace twin::hal::mujoco
