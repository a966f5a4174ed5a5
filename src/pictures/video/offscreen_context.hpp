#pragma once

#include <memory>
#include <vector>

#include "core/error.hpp"

struct osmesa_context;

namespace twin::pictures::video {

/// An OpenGL context of OSMesa, current in the thread that made it: pictures without a display or a
/// graphics card.
class OffscreenContext {
 public:
  static Expected<OffscreenContext> create();

 private:
  struct Destroy {
    void operator()(osmesa_context* context) const noexcept;
  };

  OffscreenContext() = default;

  // OSMesa wants a buffer of its own, however small; pictures are drawn into MuJoCo's offscreen
  // buffer.
  std::vector<unsigned char> buffer_;
  std::unique_ptr<osmesa_context, Destroy> context_;
};

}  // namespace twin::pictures::video
