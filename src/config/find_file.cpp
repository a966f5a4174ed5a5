#include "config/find_file.hpp"

#include <algorithm>

#include "config/nearest_name.hpp"
#include "core/this_program.hpp"

namespace twin::config {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !is_folder(path);
}

constexpr const char* kProgramEndings[] = {".nc", ".ngc", ".gcode", ".tap"};

std::vector<std::string> names_in(std::span<const fs::path> folders, std::string_view extension) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == extension) {
        names.push_back(entry.path().filename().string());
      }
    }
  }
  std::sort(names.begin(), names.end());  // a folder has no order of its own
  return names;
}

}  // namespace

std::vector<fs::path> data_folders(std::string_view name) {
  std::vector<fs::path> candidates{fs::path(name)};
  for (const fs::path& own : own_folders()) {
    // A program is in PREFIX/bin, a library in PREFIX/lib or one folder further down.
    for (const fs::path& prefix : {own.parent_path(), own.parent_path().parent_path()}) {
      candidates.push_back(prefix / TWIN_INSTALL_DATADIR / "twin" / name);
    }
  }
  candidates.push_back(fs::path(TWIN_SOURCE_DIR) / name);
  candidates.push_back(fs::path(TWIN_BINARY_DIR) / name);
  std::vector<fs::path> folders;
  std::ranges::copy_if(candidates, std::back_inserter(folders), is_folder);
  return folders;
}

Expected<fs::path> find_file(std::string_view kind, const std::string& name,
                             std::string_view extension, std::span<const fs::path> folders) {
  if (name.empty()) {
    return fail(ErrorCode::kUsage, "the name of the " + std::string(kind) + " is empty");
  }
  if (is_file(name)) {
    return fs::path(name);
  }
  const bool is_plain = name.find('/') == std::string::npos;
  for (const fs::path& folder : folders) {
    for (const std::string& file : {name, name + std::string(extension)}) {
      if (is_plain && is_file(folder / file)) {
        return folder / file;
      }
    }
  }
  if (is_folder(name)) {
    return tl::unexpected<Error>(Error{ErrorCode::kFile, "is a directory, not a file", name, 0, 0});
  }
  std::string message = "no such " + std::string(kind);
  if (is_plain) {
    for (const fs::path& folder : folders) {
      message +=
          (&folder == &folders.front() ? ", neither here nor in " : " or ") + folder.string();
    }
    std::vector<fs::path> all(folders.begin(), folders.end());
    all.emplace_back(".");
    // A name may be given without its ending.
    const bool is_whole = name.ends_with(extension);
    message +=
        did_you_mean(is_whole ? name : name + std::string(extension), names_in(all, extension));
  }
  return tl::unexpected<Error>(Error{ErrorCode::kFile, message, name, 0, 0});
}

Expected<fs::path> find_program(const std::string& name) {
  if (name == "-") {
    return fs::path("/dev/stdin");
  }
  for (const char* ending : kProgramEndings) {  // one here wins over one that comes with us
    if (!name.empty() && !is_file(name) && is_file(name + ending)) {
      return fs::path(name + ending);
    }
  }
  return find_file("NC program", name, ".nc", data_folders("nc_programs"));
}

Expected<fs::path> find_machine(const std::string& name) {
  return find_file("machine file", name, ".toml", data_folders("mjcf"));
}

}  // namespace twin::config
