#include <type_traits>

#include "live/view_module.hpp"

extern "C" __attribute__((visibility("default"))) void twin_serve_view(
    const twin::live::LiveRun* run, int port,
    twin::Expected<std::unique_ptr<twin::live::LiveView>>* view) {
  static_assert(std::is_same_v<decltype(&twin_serve_view), twin::live::ServeView>);
  *view = twin::live::serve(*run, port);
}
