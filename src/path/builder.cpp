#include "path/builder.hpp"

#include <utility>

#include "path/path_builder.hpp"
#include "path/smooth_builder.hpp"

namespace twin::path {

std::unique_ptr<Builder> make_builder(const PathSettings& settings, const PlanningModel& model,
                                      const Limits& limits, Builder::Sink sink) {
  if (is_certified(settings, model)) {
    return std::make_unique<SmoothBuilder>(settings, model, limits, std::move(sink));
  }
  return std::make_unique<PathBuilder>(settings, model, limits, std::move(sink));
}

}  // namespace twin::path
