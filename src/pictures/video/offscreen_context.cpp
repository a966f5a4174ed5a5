#include "pictures/video/offscreen_context.hpp"

#include <GL/osmesa.h>

namespace twin::pictures::video {

void OffscreenContext::Destroy::operator()(osmesa_context* context) const noexcept {
  if (OSMesaGetCurrentContext() == context) {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);  // lets go of the buffer too
  }
  OSMesaDestroyContext(context);
}

Expected<OffscreenContext> OffscreenContext::create() {
  constexpr int side = 16;  // [pixels]
  constexpr int depth_bits = 24;
  constexpr int stencil_bits = 8;
  constexpr int accum_bits = 8;
  OffscreenContext result;
  result.context_.reset(
      OSMesaCreateContextExt(OSMESA_RGBA, depth_bits, stencil_bits, accum_bits, nullptr));
  result.buffer_.resize(4UL * side * side);
  if (!result.context_ || OSMesaMakeCurrent(result.context_.get(), result.buffer_.data(),
                                            GL_UNSIGNED_BYTE, side, side) == GL_FALSE) {
    return fail(ErrorCode::kModel,
                "OSMesa gave no OpenGL context for the video; is package libosmesa6 whole?");
  }
  return result;
}

}  // namespace twin::pictures::video
