#include "feedrate/planner.hpp"

#include <algorithm>
#include <utility>

#include "feedrate/certified/certified_limits.hpp"
#include "feedrate/certified/corner_times.hpp"
#include "feedrate/certified/glide_planner.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "feedrate/limits/corners.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/paper/hump_planner.hpp"
#include "feedrate/profile/ramps.hpp"
#include "feedrate/tolerances.hpp"
#include "path/path_builder.hpp"
#include "path/smooth_builder.hpp"

namespace twin::feedrate {
namespace {

/// The limits of the paper's planner: at the samples of the curvature, as append_segment_limits has
/// them, with the machine's acceleration and jerk everywhere.
class PaperLimits final : public LimitSource {
 public:
  PaperLimits(const FeedrateRules& rules, const RampLimits& ramp) : rules_(rules), ramp_(ramp) {}

  void append(const path::Segment& segment, double s0, double feedrate,
              std::vector<LimitZone>& zones) override {
    append_segment_limits(segment, s0, feedrate, rules_, zones);
  }
  void merge(std::vector<LimitZone>& /*zones*/, std::size_t /*first*/) const override {}
  RampLimits least_ramp() const override { return ramp_; }

 private:
  FeedrateRules rules_;
  RampLimits ramp_;
};

/// What both planners are made from.
struct Settings {
  Limits limits;
  PlanningModel model;
  PathSettings path;
  double period;

  RampLimits ramp() const { return {limits.acceleration, limits.jerk, model.acceleration_profile}; }
  double corner_reach() const { return twin::feedrate::corner_reach(limits.feedrate, period); }
  std::size_t look_ahead() const { return static_cast<std::size_t>(std::max(path.look_ahead, 2)); }
};

class PaperPlanner final : public PlannerParts {
 public:
  explicit PaperPlanner(Settings settings) : of_(std::move(settings)) {}

  std::unique_ptr<path::Builder> make_builder(path::Builder::Sink sink) const override {
    return std::make_unique<path::PathBuilder>(of_.path, of_.model, of_.limits, std::move(sink));
  }
  std::unique_ptr<LimitSource> make_limits() const override {
    return std::make_unique<PaperLimits>(FeedrateRules(of_.limits, of_.model, of_.path, of_.period),
                                         of_.ramp());
  }
  std::unique_ptr<WindowPlanner> make_window_planner() const override {
    return std::make_unique<HumpPlanner>(of_.ramp(), of_.corner_reach(), of_.look_ahead());
  }

 private:
  Settings of_;
};

class CertifiedPlanner final : public PlannerParts {
 public:
  explicit CertifiedPlanner(Settings settings) : of_(std::move(settings)) {}

  std::unique_ptr<path::Builder> make_builder(path::Builder::Sink sink) const override {
    auto times = std::make_unique<CornerTimes>(
        std::make_unique<CertifiedLimits>(of_.limits, of_.model, of_.path, of_.period), of_.ramp());
    return std::make_unique<path::SmoothBuilder>(of_.path, of_.model, of_.limits, std::move(sink),
                                                 std::move(times));
  }
  std::unique_ptr<LimitSource> make_limits() const override {
    return std::make_unique<CertifiedLimits>(of_.limits, of_.model, of_.path, of_.period);
  }
  std::unique_ptr<WindowPlanner> make_window_planner() const override {
    const bool is_even = !has_axis_limits(of_.limits) && of_.limits.jerk_of == JerkOf::kPath;
    const auto ramps = is_even ? GlidePlanner::Ramps::kOfMachine : GlidePlanner::Ramps::kOfZones;
    return std::make_unique<GlidePlanner>(of_.ramp(), ramps, of_.corner_reach(), of_.look_ahead());
  }

 private:
  Settings of_;
};

}  // namespace

bool WindowPlanner::plan(Window& window, Tail tail) {
  const bool is_closed = tail == Tail::kClosed;
  const double horizon = is_closed ? window.length : window.length - corner_reach_;
  if (!is_closed && !(horizon > window.start.s + kPlaceRounding)) {
    return false;
  }
  advance(window, horizon, tail);
  return true;
}

bool raise_limits(Window& window, double last, const RampLimits& ramp) {
  const Anchor& start = window.start;
  const double to = std::min(last, start.s + longest_descent(start.v, start.v, ramp));
  bool is_raised = false;
  for (LimitZone& zone : window.zones) {
    if (zone.end > start.s && zone.begin < to && zone.limit > 0.0 && zone.limit < start.v &&
        !is_passage(zone)) {
      zone.limit = start.v;
      is_raised = true;
    }
  }
  return is_raised;
}

std::unique_ptr<PlannerParts> make_planner(const Limits& limits, const PlanningModel& model,
                                           const PathSettings& settings, double period) {
  Settings all{limits, model, settings, period};
  if (settings.planner == Planner::kCertified) {
    return std::make_unique<CertifiedPlanner>(std::move(all));
  }
  return std::make_unique<PaperPlanner>(std::move(all));
}

}  // namespace twin::feedrate
