#include "core/module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/this_program.hpp"

namespace twin {

namespace fs = std::filesystem;

std::vector<fs::path> module_places(std::string_view file) {
  std::vector<fs::path> places;
  for (const fs::path& folder : own_folders()) {
    places.push_back(folder / "twin" / file);
    places.push_back(folder.parent_path() / "lib" / "twin" / file);
    places.push_back(folder.parent_path() / TWIN_INSTALL_LIBDIR / "twin" / file);
  }
  places.emplace_back(fs::path(TWIN_BINARY_DIR) / "lib" / "twin" / file);
  places.emplace_back(fs::path(TWIN_INSTALL_FULL_LIBDIR) / "twin" / file);
  return places;
}

Expected<void*> load_module_from(const fs::path& file, const Module& module) {
  void* const handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded
  void* const function =
      handle == nullptr ? nullptr : ::dlsym(handle, std::string(module.function).c_str());
  if (function == nullptr) {
    return tl::unexpected(Error{ErrorCode::kFile,
                                fmt::format("{} cannot be loaded: {}", module.purpose, ::dlerror()),
                                file.string(), 0, 0});
  }
  return function;
}

Expected<void*> load_module(const Module& module) {
  const std::vector<fs::path> places = module_places(module.file);
  const auto found = std::ranges::find_if(places, [](const fs::path& place) {
    std::error_code ignored;
    return fs::exists(place, ignored);
  });
  if (found == places.end()) {
    std::string message =
        fmt::format("is missing; it is {}, and was looked for at", module.purpose);
    for (const fs::path& place : places) {
      message += " " + place.string();
    }
    return tl::unexpected(
        Error{ErrorCode::kFile, std::move(message), std::string(module.file), 0, 0});
  }
  return load_module_from(*found, module);
}

}  // namespace twin
