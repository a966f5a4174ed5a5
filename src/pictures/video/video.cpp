#include "pictures/video/video.hpp"

#include "core/atomic_file.hpp"
#include "core/module.hpp"
#include "core/temporary_name.hpp"
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

constexpr Module kRenderer{"twin-video.so", kRenderVideoName, "the video's renderer"};

Expected<VideoReport> write_video_by(void* function, const VideoInput& input) {
  const TemporaryName unfinished(temporary_of(input.output));  // the module has a list of its own
  Expected<VideoReport> report;
  reinterpret_cast<RenderVideo>(function)(&input, &report);
  return report;
}

}  // namespace

std::vector<std::filesystem::path> video_module_places() { return module_places(kRenderer.file); }

Expected<VideoReport> write_video_with(const std::filesystem::path& module,
                                       const VideoInput& input) {
  TWIN_TRY(void* const function, load_module_from(module, kRenderer));
  return write_video_by(function, input);
}

Expected<VideoReport> write_video(const VideoInput& input) {
  TWIN_TRY(void* const function, load_module(kRenderer));
  return write_video_by(function, input);
}

}  // namespace twin::pictures::video
