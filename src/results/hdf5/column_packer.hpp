#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;

namespace twin::results::hdf5 {

/// Packs the values of a chunk as HDF5's filters shuffle and deflate unpack them.
///
/// Shuffling puts the first bytes of all values before all second bytes, and so on. The low bytes of
/// measured numbers are noise, on which a compressor loses its time; of those bytes nothing but the
/// order is changed. They come first in the chunk: a byte plane whose entropy is high becomes a
/// stored block of the deflate stream, and from the first other plane on all is compressed.
class ColumnPacker {
 public:
  ColumnPacker();

  /// @param values  as the file has them, eight bytes each, low byte first
  /// @returns the packed bytes, valid until the next call
  std::span<const std::uint8_t> pack(std::span<const std::uint64_t> values);

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const noexcept;
  };
  void shuffle(std::span<const std::uint64_t> values);
  void put_stored(std::span<const std::uint8_t> plane);

  std::unique_ptr<libdeflate_compressor, Free> compressor_;
  std::vector<std::uint8_t> shuffled_;
  std::vector<std::uint8_t> packed_;
};

}  // namespace twin::results::hdf5
