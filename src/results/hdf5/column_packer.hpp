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
/// measured numbers are noise, in which a compressor looks for matches in vain. They come first in the
/// chunk: a byte plane of high entropy becomes a stored block of the deflate stream, one of few values
/// before it a block with a code of its own, and what follows is compressed.
class ColumnPacker {
 public:
  ColumnPacker();

  /// @param values  as the file has them, eight bytes each, low byte first
  /// @param is_full  otherwise the last ones are all equal, in place of rows that are not there
  /// @returns the packed bytes, valid until the next call
  std::span<const std::uint8_t> pack(std::span<const std::uint64_t> values, bool is_full);

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const noexcept;
  };
  void shuffle(std::span<const std::uint64_t> values);

  std::unique_ptr<libdeflate_compressor, Free> compressor_;
  std::vector<std::uint8_t> shuffled_;
  std::vector<std::uint8_t> packed_;
};

}  // namespace twin::results::hdf5
