#include "pictures/video/video.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/temporary_name.hpp"
#include "core/this_program.hpp"
#include "pictures/video/renderer.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa keeps what it set up for the first contexts in a list of its own until the process ends.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libOSMesa.so";
}
#endif
#ifdef __SANITIZE_THREAD__
// Mesa's own threads wait for each other by means that a library built without the sanitizer does
// not show.
extern "C" const char* __tsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __tsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "race:libOSMesa.so";
}
#endif

namespace twin::pictures::video {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleName = "twin-video.so";

/// The module's function; the module stays loaded, because OpenGL drivers do not survive being
/// unloaded.
Expected<RenderVideo> load_module(const fs::path& file) {
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = module == nullptr ? nullptr : dlsym(module, kRenderVideoName);
  if (function == nullptr) {
    return tl::unexpected(Error{ErrorCode::kFile,
                                fmt::format("the video's renderer cannot be loaded: {}", dlerror()),
                                file.string(), 0, 0});
  }
  return reinterpret_cast<RenderVideo>(function);
}

}  // namespace

std::vector<fs::path> video_module_places() {
  std::vector<fs::path> places;
  for (const fs::path& folder : own_folders()) {
    places.push_back(folder / "twin" / kModuleName);
    places.push_back(folder.parent_path() / "lib" / "twin" / kModuleName);
    places.push_back(folder.parent_path() / TWIN_INSTALL_LIBDIR / "twin" / kModuleName);
  }
  places.emplace_back(fs::path(TWIN_BINARY_DIR) / "lib" / "twin" / kModuleName);
  places.emplace_back(fs::path(TWIN_INSTALL_FULL_LIBDIR) / "twin" / kModuleName);
  return places;
}

Expected<VideoReport> write_video_with(const fs::path& module, const VideoInput& input) {
  TWIN_TRY(const RenderVideo render, load_module(module));
  const TemporaryName unfinished(temporary_of(input.output));  // the module has a list of its own
  Expected<VideoReport> report;
  render(&input, &report);
  return report;
}

Expected<VideoReport> write_video(const VideoInput& input) {
  const std::vector<fs::path> places = video_module_places();
  const auto found = std::ranges::find_if(places, [](const fs::path& place) {
    std::error_code ignored;
    return fs::exists(place, ignored);
  });
  if (found == places.end()) {
    std::string message = "is missing; it makes the video, and was looked for at";
    for (const fs::path& place : places) {
      message += " " + place.string();
    }
    return tl::unexpected(Error{ErrorCode::kFile, std::move(message), kModuleName, 0, 0});
  }
  return write_video_with(*found, input);
}

}  // namespace twin::pictures::video
