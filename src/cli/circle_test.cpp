#include "cli/circle_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/units.hpp"

namespace twin::cli {
namespace {

constexpr double kLeastRadius = 0.1;    // [mm]; smaller ones are made of a few set points
constexpr double kLongestTurn = 600.0;  // [s]; the paths are held in memory

Expected<void> check_radius(double radius, const Limits& limits) {
  if (!(radius >= kLeastRadius) || !std::isfinite(radius)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--radius-mm {:g} is not at least {:g}", radius, kLeastRadius));
  }
  const double room = std::min({limits.travel_max.x(), limits.travel_max.y(),
                                -limits.travel_min.x(), -limits.travel_min.y()});
  if (radius > room) {
    return fail(ErrorCode::kUsage,
                fmt::format("--radius-mm {:g} leaves the travel: about X0 Y0 there is room for "
                            "{:g} mm (limits.travel_min_mm, limits.travel_max_mm)",
                            radius, room));
  }
  return {};
}

Expected<void> check_feedrate(double feedrate, double radius, const Limits& limits) {
  const double wanted = units::mm_per_min_from_mm_per_s(feedrate);
  if (!(feedrate <= limits.feedrate)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--feedrate-mm-per-min {:g} is above the machine's largest, "
                            "limits.feedrate_mm_per_min = {:g}",
                            wanted, units::mm_per_min_from_mm_per_s(limits.feedrate)));
  }
  const double turn = 2.0 * std::numbers::pi * radius / feedrate;
  if (turn > kLongestTurn) {
    return fail(ErrorCode::kUsage,
                fmt::format("one turn of {:g} mm radius at {:g} mm/min takes {:.0f} s, more than "
                            "{:g} s",
                            radius, wanted, turn, kLongestTurn));
  }
  return {};
}

}  // namespace

Expected<CircleTest> make_circle_test(const Options& options) {
  auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  CircleTest test{std::move(*machine), options.radius_mm,
                  feedrate_of(options).value_or(units::mm_per_s_from_mm_per_min(3000.0)),
                  result_folder(options, "circle")};
  if (auto checked = check_radius(test.radius, test.machine.limits); !checked) {
    return tl::unexpected(checked.error());
  }
  if (auto checked = check_feedrate(test.feedrate, test.radius, test.machine.limits); !checked) {
    return tl::unexpected(checked.error());
  }
  return test;
}

}  // namespace twin::cli
