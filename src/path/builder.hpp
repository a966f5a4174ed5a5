#pragma once

#include <functional>

#include "gcode/block.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// Turns blocks into segments, one after the other, looking no further ahead than it needs: the
/// PathBuilder of the paper's planner, the SmoothBuilder of the certified one.
class Builder {
 public:
  using Sink = std::function<void(Segment&&)>;

  Builder() = default;
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;
  virtual ~Builder() = default;

  /// Takes the next block; segments come out of the sink as soon as they are settled.
  virtual void push(const gcode::Block& block) = 0;
  /// No more blocks follow.
  virtual void finish() = 0;
};

}  // namespace twin::path
