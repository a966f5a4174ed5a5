#pragma once

#include <functional>
#include <memory>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/block.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// Turns blocks into segments, one after the other, looking no further ahead than it needs.
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

/// SmoothBuilder where is_certified(settings, model), else PathBuilder.
std::unique_ptr<Builder> make_builder(const PathSettings& settings, const PlanningModel& model,
                                      const Limits& limits, Builder::Sink sink);

}  // namespace twin::path
