#include "hal/mujoco/mujoco_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cassert>

namespace twin::hal::mujoco {
namespace {

tl::unexpected<Error> cannot_load(std::string_view why) {
  return fail(ErrorCode::kModel, fmt::format("MuJoCo cannot be loaded: {}", why));
}

/// Takes functions and variables out of a library.
class MujocoNames {
 public:
  MujocoNames(void* library, const std::string& file) : library_(library), file_(file) {}

  const std::string& file() const { return file_; }

  /// @param target  a pointer to the function or to the variable
  template <class Pointer>
  Expected<void> take(Pointer& target, const char* name) const {
    target = reinterpret_cast<Pointer>(::dlsym(library_, name));
    return target != nullptr ? Expected<void>()
                             : cannot_load(fmt::format("{} has no {}", file_, name));
  }

 private:
  void* library_;
  const std::string& file_;
};

/// The structs of the headers must be those of the library.
Expected<void> check_version(const MujocoNames& names) {
  decltype(&::mj_version) version = nullptr;
  TWIN_CHECK(names.take(version, "mj_version"));
  if (version() != mjVERSION_HEADER) {
    return cannot_load(fmt::format("{} is version {}, but this program was compiled for version {}",
                                   names.file(), version(), mjVERSION_HEADER));
  }
  return {};
}

void throw_error(const char* text) { throw MujocoError(text); }
void ignore_warning(const char* /*text*/) {}

/// Sets what MuJoCo calls with the text of an error or a warning, for the whole process.
Expected<void> set_handlers(const MujocoNames& names) {
  decltype(&::mju_user_error) error = nullptr;
  decltype(&::mju_user_warning) warning = nullptr;
  TWIN_CHECK(names.take(error, "mju_user_error"));
  TWIN_CHECK(names.take(warning, "mju_user_warning"));
  *error = throw_error;
  *warning = ignore_warning;
  return {};
}

}  // namespace

Expected<MujocoLibrary> MujocoLibrary::open(const std::string& file) {
  void* const handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return cannot_load(::dlerror());
  }
  const MujocoNames names(handle, file);
  TWIN_CHECK(check_version(names));
  TWIN_CHECK(set_handlers(names));
  MujocoLibrary library;
  TWIN_CHECK(names.take(library.load_xml, "mj_loadXML"));
  TWIN_CHECK(names.take(library.copy_model, "mj_copyModel"));
  TWIN_CHECK(names.take(library.delete_model, "mj_deleteModel"));
  TWIN_CHECK(names.take(library.make_data, "mj_makeData"));
  TWIN_CHECK(names.take(library.delete_data, "mj_deleteData"));
  TWIN_CHECK(names.take(library.name_to_id, "mj_name2id"));
  TWIN_CHECK(names.take(library.set_const, "mj_setConst"));
  TWIN_CHECK(names.take(library.reset_data, "mj_resetData"));
  TWIN_CHECK(names.take(library.step, "mj_step"));
  return library;
}

Expected<const MujocoLibrary*> MujocoLibrary::load() {
  static const Expected<MujocoLibrary> library = open(TWIN_MUJOCO_LIBRARY);
  return library.map([](const MujocoLibrary& open_library) { return &open_library; });
}

const MujocoLibrary& MujocoLibrary::loaded() noexcept {
  static const MujocoLibrary* const library = load().value_or(nullptr);
  assert(library != nullptr);
  return *library;
}

}  // namespace twin::hal::mujoco
