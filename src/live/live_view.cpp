#include "live/live_view.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "core/this_program.hpp"
#include "live/view_module.hpp"

namespace twin::live {
namespace {

namespace fs = std::filesystem;

/// The module: beside the program, or where an installation has it.
fs::path module_file() {
  constexpr const char* kName = "twin-view.so";
  std::error_code ignored;
  for (const fs::path& own : own_folders()) {
    for (const fs::path& folder : {own / "twin", own.parent_path() / "lib" / "twin",
                                   own.parent_path() / TWIN_INSTALL_LIBDIR / "twin"}) {
      if (fs::exists(folder / kName, ignored)) {
        return folder / kName;
      }
    }
  }
  const fs::path built = fs::path(TWIN_BINARY_DIR) / "lib" / "twin" / kName;
  return fs::exists(built, ignored) ? built : fs::path(TWIN_INSTALL_FULL_LIBDIR) / "twin" / kName;
}

}  // namespace

Expected<std::unique_ptr<LiveView>> open_live_view(const LiveRun& run, int port) {
  const fs::path file = module_file();
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded
  void* const function = module == nullptr ? nullptr : dlsym(module, kServeViewName);
  if (function == nullptr) {
    return tl::unexpected(Error{ErrorCode::kFile,
                                fmt::format("the server of --view cannot be loaded: {}", dlerror()),
                                file.string(), 0, 0});
  }
  Expected<std::unique_ptr<LiveView>> view;
  reinterpret_cast<ServeView>(function)(&run, port, &view);
  return view;
}

}  // namespace twin::live
