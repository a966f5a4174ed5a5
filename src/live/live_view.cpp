#include "live/live_view.hpp"

#include "core/module.hpp"
#include "live/view_module.hpp"

namespace twin::live {

Expected<std::unique_ptr<LiveView>> open_live_view(const LiveRun& run, int port) {
  TWIN_TRY(void* const function,
           load_module({"twin-view.so", kServeViewName, "the server of --view"}));
  Expected<std::unique_ptr<LiveView>> view;
  reinterpret_cast<ServeView>(function)(&run, port, &view);
  return view;
}

}  // namespace twin::live
