#include "pictures/video/renderer.hpp"

#include <type_traits>

extern "C" __attribute__((visibility("default"))) void twin_render_video(
    const twin::pictures::video::VideoInput* input,
    twin::Expected<twin::pictures::video::VideoReport>* report) {
  static_assert(std::is_same_v<decltype(&twin_render_video), twin::pictures::video::RenderVideo>);
  *report = twin::pictures::video::render_video(*input);
}
