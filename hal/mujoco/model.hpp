#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>

#include "core/error.hpp"

namespace twin::hal::mujoco {

struct ModelDeleter {
  void operator()(mjModel* model) const noexcept;
};
struct DataDeleter {
  void operator()(mjData* data) const noexcept;
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;
using DataPtr = std::unique_ptr<mjData, DataDeleter>;

/// Loads an MJCF file, and MuJoCo itself where this is the first. Missing, unreadable and broken
/// files are kModel errors with MuJoCo's own words and the line.
Expected<ModelPtr> load_model(const std::filesystem::path& file);

/// State for a model; kModel error when MuJoCo refuses it.
Expected<DataPtr> make_data(const mjModel& model);

/// Number of a named thing, or a kModel error that names what is missing.
/// @param type mjOBJ_JOINT, mjOBJ_BODY, ...  @param kind the same as a word, for the message
Expected<int> find_id(const mjModel& model, mjtObj type, const std::string& kind,
                      const std::string& name);

}  // namespace twin::hal::mujoco
