#pragma once

#include <memory>

#include "core/error.hpp"
#include "live/live_view.hpp"

namespace twin::live {

/// What open_live_view() does, in the module itself.
Expected<std::unique_ptr<LiveView>> serve(const LiveRun& run, int port);

/// Type and name of the one function that twin-view.so shows.
///
/// @param view  gets what serve() returns
using ServeView = void (*)(const LiveRun* run, int port, Expected<std::unique_ptr<LiveView>>* view);
inline constexpr const char* kServeViewName = "twin_serve_view";

}  // namespace twin::live
