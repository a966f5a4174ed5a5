#include "twin/video.hpp"

#include "library/inside.hpp"
#include "session/pictures.hpp"

namespace twin {

void render_video(const std::string& folder, const Settings& settings,
                  const VideoOptions& options) {
  const session::TraceOrigin origin = value_of(session::read_origin(folder));
  check(session::render_video({.folder = folder,
                               .model = Inside::of(settings).table.model,
                               .title = options.title.empty() ? origin.program : options.title,
                               .camera = options.camera,
                               .progress = options.progress}));
}

}  // namespace twin
