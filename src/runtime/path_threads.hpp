#pragma once

#include <optional>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "path/builder.hpp"
#include "path/segment.hpp"
#include "runtime/hand_over.hpp"
#include "runtime/shared_blocks.hpp"

namespace twin::runtime {

/// Reads a program and builds its path in two threads beside the caller's, which plans the
/// feedrate:
///
///   reading --blocks--> path building --segments--> caller
///
/// The same calls in the same order as in one thread, so the same segments. Where reading fails,
/// the caller still gets the segments of the blocks before; then join() has the error.
class PathThreads {
 public:
  /// @param read     gives the blocks; called in the thread that reads
  /// @param builder  whose sink is push(); used in the thread that builds
  PathThreads(BlockSource read, path::Builder& builder)
      : read_(std::move(read)), builder_(builder) {}
  PathThreads(const PathThreads&) = delete;
  PathThreads& operator=(const PathThreads&) = delete;
  ~PathThreads() { join_threads(); }

  void start();

  /// Takes a segment from the builder.
  void push(path::Segment&& segment) {
    is_wanted_ = is_wanted_ && segments_.push(std::move(segment));
  }

  /// The next segment of the path, for the caller; null at its end.
  path::Segment* next() { return segments_.next(); }

  /// Ends the threads, also before the end of the path. @returns why reading or building failed
  Expected<void> join();

 private:
  void read_all();
  Expected<void> read_on();
  void build_all();
  void build_on();
  void join_threads();

  BlockSource read_;
  path::Builder& builder_;
  HandOver<gcode::Block> blocks_{256, 4};
  HandOver<path::Segment> segments_{32, 4};
  bool is_wanted_ = true;             // of the thread that builds
  std::optional<Error> read_error_;   // written before blocks_ is closed
  std::optional<Error> build_error_;  // written before segments_ is closed
  std::thread building_;
  std::thread reading_;
};

}  // namespace twin::runtime
