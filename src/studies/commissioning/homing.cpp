#include "studies/commissioning/homing.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twin::studies::commissioning {
namespace {

constexpr double kMargin = 1.1;           // more than the longest way there can be
constexpr double kFarthestBehind = 10.0;  // that an axis runs on behind the switch [mm]

/// A move that must meet something.
Expected<HomingStop> seek(const HomingMove& wanted, const char* what, const MakeMove& move) {
  auto stop = move(wanted);
  if (stop && !stop->met_at) {
    return fail(ErrorCode::kMachine,
                fmt::format("axis {}: {} was not met within {:.1f} mm; it stands {:.3f} mm from "
                            "where this search began",
                            wanted.axis == hal::kX ? 'x' : 'y', what, std::abs(wanted.distance),
                            stop->position));
  }
  return stop;
}

}  // namespace

Expected<void> home_axis(hal::Axis axis, const config::HomeSettings& settings, double length,
                         double lead, const MakeMove& move) {
  const double outward = settings.is_positive ? 1.0 : -1.0;
  HomingMove next{axis, settings.is_positive, outward * kMargin * length, settings.seek_feedrate,
                  Until::kLimitReached};
  TWIN_CHECK(seek(next, "the limit switch", move));
  next.distance = -outward * (kMargin * lead + kFarthestBehind);
  next.feedrate = settings.index_feedrate;
  next.until = Until::kIndex;
  TWIN_TRY(const auto index, seek(next, "the index", move));
  next.distance = *index.met_at - index.position + settings.zero;
  next.feedrate = settings.seek_feedrate;
  next.until = Until::kNothing;
  return move(next).map([](const HomingStop&) {});
}

}  // namespace twin::studies::commissioning
