#pragma once

#include <cstdint>
#include <filesystem>

namespace twin::bench {

/// A temporary NC program: a wavy path of short blocks, 4 decimals as CAM writes them.
///
/// The file is gone with the object.
class WavyFile {
 public:
  /// @param block_length  [mm]
  WavyFile(std::int64_t blocks, double block_length);
  WavyFile(const WavyFile&) = delete;
  WavyFile& operator=(const WavyFile&) = delete;
  ~WavyFile();

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace twin::bench
