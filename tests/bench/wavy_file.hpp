#pragma once

#include <cstdint>
#include <filesystem>

namespace twin::bench {

/// What a path of short blocks looks like.
enum class PathShape : std::uint8_t {
  kWavy,    ///< a wave, smooth but for the 4 decimals
  kZigzag,  ///< each block at 90 degrees to the one before
};

/// A temporary NC program: a path of short blocks, 4 decimals as CAM writes them.
///
/// The file is gone with the object.
class WavyFile {
 public:
  /// @param block_length  [mm]
  WavyFile(std::int64_t blocks, double block_length, PathShape shape = PathShape::kWavy);
  WavyFile(const WavyFile&) = delete;
  WavyFile& operator=(const WavyFile&) = delete;
  ~WavyFile();

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace twin::bench
