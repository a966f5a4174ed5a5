#include "core/this_program.hpp"

#include <dlfcn.h>

#include <string_view>
#include <system_error>

namespace twin {
namespace {

constexpr std::string_view kPlain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";

std::string quoted(std::string_view word) {
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

}  // namespace

std::string_view version() noexcept { return TWIN_VERSION; }

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

std::filesystem::path program_beside(std::string_view name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

std::string shell_quoted(std::span<const char* const> words) {
  std::string line;
  for (const char* const word : words) {
    line += (line.empty() ? "" : " ") + quoted(word);
  }
  return line;
}

}  // namespace twin
