#include "render/offscreen_context.hpp"

#include <GL/osmesa.h>

namespace twin::render {

void OffscreenContext::Destroy::operator()(osmesa_context* context) const noexcept {
  OSMesaDestroyContext(context);
}

Expected<OffscreenContext> OffscreenContext::create() {
  constexpr int kSide = 16;  // [pixels]
  constexpr int kDepthBits = 24;
  constexpr int kStencilBits = 8;
  constexpr int kAccumBits = 8;
  OffscreenContext result;
  result.context_.reset(
      OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, kStencilBits, kAccumBits, nullptr));
  result.buffer_.resize(4UL * kSide * kSide);
  if (!result.context_ || OSMesaMakeCurrent(result.context_.get(), result.buffer_.data(),
                                            GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE) {
    return fail(ErrorCode::kModel,
                "OSMesa gave no OpenGL context for the video; is package libosmesa6 whole?");
  }
  return result;
}

}  // namespace twin::render
