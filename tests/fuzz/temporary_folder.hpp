#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "tests/fuzz/target.hpp"

namespace twin::fuzz {

/// A folder that stands as long as its object, for what reads files by their names.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    char name[] = "/tmp/twin_fuzz_XXXXXX";
    promise(::mkdtemp(name) != nullptr, "no folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Writes a file, in place of one that may be there. @returns its path
  std::filesystem::path write(const std::filesystem::path& name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace twin::fuzz
