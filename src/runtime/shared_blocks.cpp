#include "runtime/shared_blocks.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace twin::runtime {
namespace {

constexpr std::size_t kBlocksOfChunk = 64;

}  // namespace

std::size_t SharedBlocks::stored() const {
  const std::lock_guard lock(mutex_);
  return kept_.size();
}

Expected<std::optional<gcode::Block>> SharedBlocks::next(std::size_t side) {
  Chunk& chunk = chunks_[side];
  if (chunk.next == chunk.blocks.size()) {
    TWIN_CHECK(fetch(side));
  }
  return chunk.blocks.empty() ? std::nullopt : std::optional(std::move(chunk.blocks[chunk.next++]));
}

/// Gets the next chunk of a side: the kept blocks, or new ones from the program.
Expected<void> SharedBlocks::fetch(std::size_t side) {
  Chunk& chunk = chunks_[side];
  chunk.blocks.clear();
  chunk.next = 0;
  const std::lock_guard lock(mutex_);
  if (side != faster_ && !kept_.empty()) {
    const auto end =
        kept_.begin() + static_cast<std::ptrdiff_t>(std::min(kept_.size(), kBlocksOfChunk));
    std::move(kept_.begin(), end, std::back_inserter(chunk.blocks));
    kept_.erase(kept_.begin(), end);
    return {};
  }
  faster_ = side;
  while (chunk.blocks.size() < kBlocksOfChunk) {
    auto block = reader_.next();
    if (!block && chunk.blocks.empty()) {
      return tl::unexpected(std::move(block).error());
    }
    if (!block || !*block) {
      break;  // an error comes again when the blocks before it have been used
    }
    kept_.push_back(**block);
    chunk.blocks.push_back(*std::move(*block));
  }
  return {};
}

}  // namespace twin::runtime
