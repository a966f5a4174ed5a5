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
/// Whoever is ahead reads the program on and leaves a copy of the blocks for the other one. So the
/// memory used is that of the blocks between the two, and neither waits for the other. Blocks move
/// in chunks, so that the lock is seldom needed.
class SharedBlocks {
 public:
  explicit SharedBlocks(gcode::Reader&& reader) : reader_(std::move(reader)) {}
  SharedBlocks(const SharedBlocks&) = delete;
  SharedBlocks& operator=(const SharedBlocks&) = delete;
  ~SharedBlocks() = default;

  /// The two sources; each may be called by one thread at a time.
  BlockSource first() {
    return [this] { return next(0); };
  }
  BlockSource second() {
    return [this] { return next(1); };
  }

  /// The first source is not used any more: nothing is kept for it.
  void drop_first();

  /// Blocks that are kept for the slower of the two.
  std::size_t stored() const;

 private:
  struct Chunk {
    std::vector<gcode::Block> blocks;
    std::size_t next = 0;
  };

  Expected<std::optional<gcode::Block>> next(std::size_t side);
  Expected<void> fetch(std::size_t side);

  std::array<Chunk, 2> chunks_;  // of each side, used by it alone
  mutable std::mutex mutex_;     // of what follows
  gcode::Reader reader_;
  std::deque<gcode::Block> kept_;  // that the slower side has not got yet
  std::size_t faster_ = 0;         // side that has got them
  bool is_shared_ = true;          // both sides are in use
};

}  // namespace twin::runtime
