#include "core/own_folders.hpp"

#include <dlfcn.h>

#include <string_view>
#include <system_error>

namespace twin {

std::vector<std::filesystem::path> own_folders() {
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;
  std::error_code error;
  static const char anchor = 0;  // any address in this library or program
  Dl_info info{};
  // A program's own entry has the name it was started by, which need not be a path.
  if (dladdr(&anchor, &info) != 0 &&
      std::string_view(info.dli_fname).find(".so") != std::string_view::npos) {
    if (const fs::path library = fs::canonical(info.dli_fname, error); !error) {
      folders.push_back(library.parent_path());
    }
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error && (folders.empty() || folders.front() != program.parent_path())) {
    folders.push_back(program.parent_path());
  }
  return folders;
}

}  // namespace twin
