#include "hal/mujoco/model.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <mutex>
#include <string>

#include "core/atomic_file.hpp"
#include "hal/mujoco/mujoco_library.hpp"

namespace twin::hal::mujoco {

void ModelDeleter::operator()(mjModel* model) const noexcept {
  MujocoLibrary::loaded().delete_model(model);
}

void DataDeleter::operator()(mjData* data) const noexcept {
  MujocoLibrary::loaded().delete_data(data);
}

namespace {

/// MuJoCo's text on one line, without the prefix that every message has.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') {
      c = ' ';
    }
  }
  const auto end = text.find_last_not_of(' ');
  text.resize(end == std::string::npos ? 0 : end + 1);
  return text;
}

tl::unexpected<Error> model_error(const std::filesystem::path& file, std::string message) {
  return tl::unexpected<Error>(Error{ErrorCode::kModel, std::move(message), file.string(), 0, 0});
}

/// Models that have been compiled, by the text of their file. Compiling takes a tenth of the time of
/// a short run, most of it for textures that are then discarded.
class CompiledModels {
 public:
  /// A copy of the model of a text; null if there is none.
  ModelPtr copy_of(const std::filesystem::path& file, const std::string& text) {
    const std::lock_guard lock(mutex_);
    const auto found = models_.find(key_of(file, text));
    return found == models_.end()
               ? nullptr
               : ModelPtr(MujocoLibrary::loaded().copy_model(nullptr, found->second.get()));
  }

  /// Keeps a copy of a model. A text that names other files is not kept, for they may change.
  void keep(const std::filesystem::path& file, const std::string& text, const mjModel& model) {
    if (text.find("<include") != std::string::npos || text.find("file=") != std::string::npos) {
      return;
    }
    const std::lock_guard lock(mutex_);
    if (models_.size() == kMost) {
      models_.clear();
    }
    models_[key_of(file, text)] = ModelPtr(MujocoLibrary::loaded().copy_model(nullptr, &model));
  }

 private:
  static constexpr std::size_t kMost = 8;  // models, some 100 kB each

  static std::string key_of(const std::filesystem::path& file, const std::string& text) {
    return file.string() + '\n' + text;
  }

  std::mutex mutex_;
  std::map<std::string, ModelPtr> models_;
};

CompiledModels& compiled_models() {
  static CompiledModels models;
  return models;
}

Expected<ModelPtr> compile(const MujocoLibrary& mujoco, const std::filesystem::path& file) {
  std::array<char, 1000> text{};
  try {
    ModelPtr model(
        mujoco.load_xml(file.c_str(), nullptr, text.data(), static_cast<int>(text.size())));
    if (!model) {
      return model_error(file, fmt::format("MuJoCo cannot load it: {}", one_line(text.data())));
    }
    return model;
  } catch (const MujocoError& error) {
    return model_error(file, fmt::format("MuJoCo cannot load it: {}", one_line(error.what())));
  }
}

}  // namespace

Expected<ModelPtr> load_model(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) {
    return model_error(file,
                       "no such MJCF file; table.model names it, beside the machine file or in the "
                       "program's folder mjcf");
  }
  TWIN_TRY(const MujocoLibrary* const mujoco, MujocoLibrary::load());
  TWIN_TRY(const std::string text, read_whole_file(file));
  if (ModelPtr copy = compiled_models().copy_of(file, text)) {
    return copy;
  }
  TWIN_TRY(ModelPtr model, compile(*mujoco, file));
  compiled_models().keep(file, text, *model);
  return model;
}

Expected<DataPtr> make_data(const mjModel& model) {
  try {
    DataPtr data(MujocoLibrary::loaded().make_data(&model));
    if (data) {
      return data;
    }
    return fail(ErrorCode::kModel, "MuJoCo cannot make the state of the model: out of memory");
  } catch (const MujocoError& error) {
    return fail(ErrorCode::kModel, fmt::format("MuJoCo cannot make the state of the model: {}",
                                               one_line(error.what())));
  }
}

Expected<int> find_id(const mjModel& model, mjtObj type, const std::string& kind,
                      const std::string& name) {
  const int id = MujocoLibrary::loaded().name_to_id(&model, type, name.c_str());
  if (id < 0) {
    return fail(ErrorCode::kModel, fmt::format("the model has no {} named \"{}\"", kind, name));
  }
  return id;
}

}  // namespace twin::hal::mujoco
