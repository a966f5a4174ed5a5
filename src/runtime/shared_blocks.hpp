#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/reader.hpp"

namespace twin::runtime {

/// Gives the blocks of a program one by one; nothing at its end.
using BlockSource = std::function<Expected<std::optional<gcode::Block>>()>;

/// One reading of a program for two threads, each of which goes through all blocks at its own pace.
///
///   program  ...........|=============|............
///                       ^ the slower   ^ the faster one: reads on
///
/// The thread that is ahead reads the program and keeps a copy of each block for the other thread.
/// So only the blocks between the two are in memory, and no thread waits for the other. Blocks are
/// handed over in chunks, so that the lock is seldom needed.
class SharedBlocks {
 public:
  explicit SharedBlocks(gcode::Reader&& reader) : reader_(std::move(reader)) {}
  SharedBlocks(const SharedBlocks&) = delete;
  SharedBlocks& operator=(const SharedBlocks&) = delete;
  ~SharedBlocks() = default;

  /// The sources for the two threads. Only one thread at a time may call each of them.
  BlockSource first() {
    return [this] { return next(0); };
  }
  BlockSource second() {
    return [this] { return next(1); };
  }

  /// Says that the first source is not used any more, so no block is kept for it.
  void drop_first();

  /// Number of blocks that are kept for the slower thread.
  std::size_t stored() const;

 private:
  struct Chunk {
    std::vector<gcode::Block> blocks;
    std::size_t next = 0;
  };

  Expected<std::optional<gcode::Block>> next(std::size_t side);
  Expected<void> fetch(std::size_t side);

  std::array<Chunk, 2> chunks_;  // one for each source, used by its thread alone
  mutable std::mutex mutex_;     // protects the members that follow
  gcode::Reader reader_;
  std::deque<gcode::Block> kept_;  // blocks that only the faster source has given so far
  std::size_t faster_ = 0;         // index of the faster source
  bool is_shared_ = true;          // both sources are in use
};

}  // namespace twin::runtime
