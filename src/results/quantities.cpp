#include "results/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/units.hpp"

namespace twin::results {
namespace {

using units::um_from_mm;
using enum Group;
using enum QuantityKind;

using S = Summary;
using R = MachineResults;
using W = RealTimeStats;
using C = CuttingStats;
using CR = CuttingErrors;
using AuditPlaces = OfEachPeak<std::optional<Place>>;
using AxisPlaces = OfEachAxisPeak<std::optional<Place>>;
using Optional = std::optional<double>;

constexpr double same(double x) { return x; }
constexpr double us_from_s(double s) { return s * 1e6; }
constexpr double percent(double share) { return 1e2 * share; }

std::optional<Place> value_of(const std::optional<Place>& x) { return x; }
Optional value_of(double x) { return x; }
Optional value_of(std::int64_t x) { return static_cast<double>(x); }
Optional value_of(const Optional& x) { return x; }

/// Follows members, or places in an array, from a struct down to a number. An optional on the way
/// that is empty gives nothing.
template <class To, auto first, auto... rest, class From>
To follow(const From& from) {
  const auto& field = [&]() -> const auto& {
    if constexpr (std::is_integral_v<decltype(first)>) {
      return from[first];
    } else {
      return from.*first;
    }
  }
  ();
  if constexpr (sizeof...(rest) == 0) {
    return value_of(field);
  } else if constexpr (requires { field.has_value(); }) {
    return field ? follow<To, rest...>(*field) : To();
  } else {
    return follow<To, rest...>(field);
  }
}

/// Getter of the number at the end of some members, times its unit.
template <double (*in_unit)(double), auto... members>
Optional get(const Summary& summary) {
  const Optional value = follow<Optional, members...>(summary);
  return value ? Optional(in_unit(*value)) : Optional();
}

/// Getter of the place at the end of some members.
template <auto... members>
std::optional<Place> at(const Summary& summary) {
  return follow<std::optional<Place>, members...>(summary);
}

Optional bound_ratio(const Summary& s) {
  return s.time_bound ? Optional(s.planned_time / *s.time_bound) : Optional();
}

/// Left out where there are none.
Optional plan_fallbacks(const Summary& s) {
  return s.plan_fallbacks > 0 ? Optional(static_cast<double>(s.plan_fallbacks)) : Optional();
}

double at_least_one(std::int64_t count) {
  return static_cast<double>(std::max<std::int64_t>(count, 1));
}

Optional blocks_per_segment(const Summary& s) {
  return static_cast<double>(s.blocks.total) / at_least_one(s.segments.total);
}

Optional planning_time_ms(const Summary& s) {
  return s.planning_time ? Optional(1e3 * *s.planning_time) : Optional();
}

Optional planning_time_per_block_us(const Summary& s) {
  return s.planning_time ? Optional(1e6 * *s.planning_time / at_least_one(s.blocks.total))
                         : Optional();
}

double feedrate_limit(const Limits& l) { return l.feedrate; }
double acceleration_limit(const Limits& l) { return l.acceleration; }
double jerk_limit(const Limits& l) { return l.jerk; }

// clang-format off
constexpr auto kQuantities = std::to_array<Quantity>({
    // key, pointer
    //     label, statistic, unit, decimals, group, kind, getter, limit
    {"period_s", "/period_s",
         "period", "", "s", 4, kRun, kMeasure, get<same, &S::period>},
    {"blocks", "/blocks/total",
         "blocks", "", "", 0, kPath, kCount, get<same, &S::blocks, &BlockStats::total>},
    {"short_blocks", "/blocks/short",
         "short blocks", "", "", 0, kPath, kCount, get<same, &S::blocks, &BlockStats::short_blocks>},
    {"block_length_min_mm", "/blocks/length_mm/min",
         "length of short blocks", "min", "mm", 3, kPath, kMeasure,
         get<same, &S::blocks, &BlockStats::length_min>},
    {"block_length_mean_mm", "/blocks/length_mm/mean",
         "length of short blocks", "mean", "mm", 3, kPath, kMeasure,
         get<same, &S::blocks, &BlockStats::length_mean>},
    {"block_length_max_mm", "/blocks/length_mm/max",
         "length of short blocks", "max", "mm", 3, kPath, kMeasure,
         get<same, &S::blocks, &BlockStats::length_max>},
    {"segments", "/segments/total",
         "segments", "", "", 0, kPath, kCount, get<same, &S::segments, &SegmentCounts::total>},
    {"curves", "/segments/curves",
         "curves", "", "", 0, kPath, kCount, get<same, &S::segments, &SegmentCounts::curves>},
    {"lines", "/segments/lines",
         "lines", "", "", 0, kPath, kCount, get<same, &S::segments, &SegmentCounts::lines>},
    {"arcs", "/segments/arcs",
         "arcs", "", "", 0, kPath, kCount, get<same, &S::segments, &SegmentCounts::arcs>},
    {"spans", "/segments/spans",
         "spans", "", "", 0, kPath, kCount, get<same, &S::certified, &Certificate::spans>},
    {"blocks_per_segment", "",
         "blocks per segment", "", "", 2, kPath, kMeasure, blocks_per_segment},
    {"compression_factor", "/compression_factor",
         "compression factor", "", "", 2, kPath, kMeasure, get<same, &S::compression_factor>},
    {"path_length_mm", "/path_length_mm",
         "path length", "", "mm", 3, kPath, kMeasure, get<same, &S::path_length>},
    {"planned_time_s", "/planned_time_s",
         "planned time", "", "s", 3, kPath, kMeasure, get<same, &S::planned_time>},
    {"plan_fallbacks", "/plan_fallbacks",
         "plan fallbacks", "", "", 0, kPath, kCount, plan_fallbacks},
    {"time_bound_s", "/time_bound_s",
         "lower bound of the time", "", "s", 3, kPath, kMeasure, get<same, &S::time_bound>},
    {"bound_ratio", "/bound_ratio",
         "planned time / bound", "", "", 4, kPath, kMeasure, bound_ratio},
    {"machining_time_s", "/machining_time_s",
         "machining time", "", "s", 3, kPath, kMeasure, get<same, &S::run, &R::machining_time>},
    {"certified_deviation_um", "/certified_deviation_um",
         "certified deviation", "", "um", 3, kPath, kMeasure,
         get<um_from_mm, &S::certified, &Certificate::deviation>},

    {"command_contour_error_max_um", "/command_contour_error_um/max",
         "contour error, command", "max", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::command_contour_error, &ErrorStats::max>, nullptr,
         at<&S::command_contour_error, &ErrorStats::at>},
    {"command_contour_error_rms_um", "/command_contour_error_um/rms",
         "contour error, command", "rms", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::command_contour_error, &ErrorStats::rms>},
    {"contour_error_max_um", "/contour_error_um/max",
         "contour error, encoder", "max", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::contour_error, &ErrorStats::max>, nullptr,
         at<&S::run, &R::contour_error, &ErrorStats::at>},
    {"contour_error_rms_um", "/contour_error_um/rms",
         "contour error, encoder", "rms", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::contour_error, &ErrorStats::rms>},
    {"table_contour_error_max_um", "/table_contour_error_um/max",
         "contour error, table", "max", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::table_contour_error, &ErrorStats::max>, nullptr,
         at<&S::run, &R::table_contour_error, &ErrorStats::at>},
    {"table_contour_error_rms_um", "/table_contour_error_um/rms",
         "contour error, table", "rms", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::table_contour_error, &ErrorStats::rms>},
    {"x_tracking_error_max_um", "/tracking_error_um/x/max",
         "tracking error, x", "max", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::tracking_error, 0, &ErrorStats::max>, nullptr,
         at<&S::run, &R::tracking_error, 0, &ErrorStats::at>},
    {"x_tracking_error_rms_um", "/tracking_error_um/x/rms",
         "tracking error, x", "rms", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::tracking_error, 0, &ErrorStats::rms>},
    {"y_tracking_error_max_um", "/tracking_error_um/y/max",
         "tracking error, y", "max", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::tracking_error, 1, &ErrorStats::max>, nullptr,
         at<&S::run, &R::tracking_error, 1, &ErrorStats::at>},
    {"y_tracking_error_rms_um", "/tracking_error_um/y/rms",
         "tracking error, y", "rms", "um", 3, kErrors, kMeasure,
         get<um_from_mm, &S::run, &R::tracking_error, 1, &ErrorStats::rms>},
    {"feedrate_fluctuation_max_percent", "/feedrate_fluctuation_percent/max",
         "feedrate fluctuation", "max", "%", 4, kErrors, kMeasure,
         get<percent, &S::feedrate_fluctuation, &ShareStats::max>},
    {"feedrate_fluctuation_rms_percent", "/feedrate_fluctuation_percent/rms",
         "feedrate fluctuation", "rms", "%", 4, kErrors, kMeasure,
         get<percent, &S::feedrate_fluctuation, &ShareStats::rms>},

    {"cutting_time_s", "/cutting/time_s",
         "cutting time", "", "s", 3, kCutting, kMeasure, get<same, &S::cutting, &C::time>},
    {"cutting_command_contour_error_max_um", "/cutting/command_contour_error_um/max",
         "cutting, command", "max", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::command_contour_error, &ErrorStats::max>, nullptr,
         at<&S::cutting, &C::command_contour_error, &ErrorStats::at>},
    {"cutting_command_contour_error_rms_um", "/cutting/command_contour_error_um/rms",
         "cutting, command", "rms", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::command_contour_error, &ErrorStats::rms>},
    {"cutting_contour_error_max_um", "/cutting/contour_error_um/max",
         "cutting, encoder", "max", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::contour_error, &ErrorStats::max>, nullptr,
         at<&S::cutting, &C::run, &CR::contour_error, &ErrorStats::at>},
    {"cutting_contour_error_rms_um", "/cutting/contour_error_um/rms",
         "cutting, encoder", "rms", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::contour_error, &ErrorStats::rms>},
    {"cutting_table_contour_error_max_um", "/cutting/table_contour_error_um/max",
         "cutting, table", "max", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::table_contour_error, &ErrorStats::max>, nullptr,
         at<&S::cutting, &C::run, &CR::table_contour_error, &ErrorStats::at>},
    {"cutting_table_contour_error_rms_um", "/cutting/table_contour_error_um/rms",
         "cutting, table", "rms", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::table_contour_error, &ErrorStats::rms>},
    {"cutting_x_tracking_error_max_um", "/cutting/tracking_error_um/x/max",
         "cutting, tracking, x", "max", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::tracking_error, 0, &ErrorStats::max>, nullptr,
         at<&S::cutting, &C::run, &CR::tracking_error, 0, &ErrorStats::at>},
    {"cutting_x_tracking_error_rms_um", "/cutting/tracking_error_um/x/rms",
         "cutting, tracking, x", "rms", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::tracking_error, 0, &ErrorStats::rms>},
    {"cutting_y_tracking_error_max_um", "/cutting/tracking_error_um/y/max",
         "cutting, tracking, y", "max", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::tracking_error, 1, &ErrorStats::max>, nullptr,
         at<&S::cutting, &C::run, &CR::tracking_error, 1, &ErrorStats::at>},
    {"cutting_y_tracking_error_rms_um", "/cutting/tracking_error_um/y/rms",
         "cutting, tracking, y", "rms", "um", 3, kCutting, kMeasure,
         get<um_from_mm, &S::cutting, &C::run, &CR::tracking_error, 1, &ErrorStats::rms>},

    {"feedrate_peak_mm_per_s", "/audit/feedrate_mm_per_s",
         "feedrate", "peak", "mm/s", 1, kPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::feedrate>, feedrate_limit,
         at<&S::audit_at, &AuditPlaces::feedrate>},
    {"tangential_acceleration_peak_mm_per_s2", "/audit/tangential_acceleration_mm_per_s2",
         "tangential acceleration", "peak", "mm/s^2", 1, kPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::tangential_acceleration>, acceleration_limit,
         at<&S::audit_at, &AuditPlaces::tangential_acceleration>},
    {"tangential_jerk_peak_mm_per_s3", "/audit/tangential_jerk_mm_per_s3",
         "tangential jerk", "peak", "mm/s^3", 1, kPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::tangential_jerk>, jerk_limit,
         at<&S::audit_at, &AuditPlaces::tangential_jerk>},
    {"normal_acceleration_peak_mm_per_s2", "/audit/normal_acceleration_mm_per_s2",
         "normal acceleration", "peak", "mm/s^2", 1, kPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::normal_acceleration>, acceleration_limit,
         at<&S::audit_at, &AuditPlaces::normal_acceleration>},
    {"vector_jerk_peak_mm_per_s3", "/audit/vector_jerk_mm_per_s3",
         "jerk, vector", "peak", "mm/s^3", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::vector_jerk>, nullptr,
         at<&S::audit_at, &AuditPlaces::vector_jerk>},
    {"x_velocity_peak_mm_per_s", "/audit/axis/x/velocity_mm_per_s",
         "velocity, x", "peak", "mm/s", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 0, &AxisPeaks::velocity>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 0, &AxisPlaces::velocity>},
    {"x_acceleration_peak_mm_per_s2", "/audit/axis/x/acceleration_mm_per_s2",
         "acceleration, x", "peak", "mm/s^2", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 0, &AxisPeaks::acceleration>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 0, &AxisPlaces::acceleration>},
    {"x_jerk_peak_mm_per_s3", "/audit/axis/x/jerk_mm_per_s3",
         "jerk, x", "peak", "mm/s^3", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 0, &AxisPeaks::jerk>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 0, &AxisPlaces::jerk>},
    {"y_velocity_peak_mm_per_s", "/audit/axis/y/velocity_mm_per_s",
         "velocity, y", "peak", "mm/s", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 1, &AxisPeaks::velocity>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 1, &AxisPlaces::velocity>},
    {"y_acceleration_peak_mm_per_s2", "/audit/axis/y/acceleration_mm_per_s2",
         "acceleration, y", "peak", "mm/s^2", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 1, &AxisPeaks::acceleration>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 1, &AxisPlaces::acceleration>},
    {"y_jerk_peak_mm_per_s3", "/audit/axis/y/jerk_mm_per_s3",
         "jerk, y", "peak", "mm/s^3", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 1, &AxisPeaks::jerk>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 1, &AxisPlaces::jerk>},
    {"z_velocity_peak_mm_per_s", "/audit/axis/z/velocity_mm_per_s",
         "velocity, z", "peak", "mm/s", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 2, &AxisPeaks::velocity>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 2, &AxisPlaces::velocity>},
    {"z_acceleration_peak_mm_per_s2", "/audit/axis/z/acceleration_mm_per_s2",
         "acceleration, z", "peak", "mm/s^2", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 2, &AxisPeaks::acceleration>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 2, &AxisPlaces::acceleration>},
    {"z_jerk_peak_mm_per_s3", "/audit/axis/z/jerk_mm_per_s3",
         "jerk, z", "peak", "mm/s^3", 1, kAxisPeaks, kMeasure,
         get<same, &S::audit, &AuditPeaks::axis, 2, &AxisPeaks::jerk>, nullptr,
         at<&S::audit_at, &AuditPlaces::axis, 2, &AxisPlaces::jerk>},

    {"cycle_time_p50_us", "/cycle_time_us/p50",
         "cycle time", "median", "us", 2, kCycle, kMeasure,
         get<us_from_s, &S::run, &R::cycle_time, &CycleTimes::p50>},
    {"cycle_time_p99_us", "/cycle_time_us/p99",
         "cycle time", "p99", "us", 2, kCycle, kMeasure,
         get<us_from_s, &S::run, &R::cycle_time, &CycleTimes::p99>},
    {"cycle_time_max_us", "/cycle_time_us/max",
         "cycle time", "max", "us", 2, kCycle, kMeasure,
         get<us_from_s, &S::run, &R::cycle_time, &CycleTimes::max>},
    {"real_time_factor", "/real_time_factor",
         "real time factor", "", "", 1, kCycle, kMeasure, get<same, &S::run, &R::real_time_factor>},

    {"wake_up_p50_us", "/realtime/wake_up_us/p50",
         "wake-up after deadline", "median", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::wake_up, &TimeStats::p50>},
    {"wake_up_p99_us", "/realtime/wake_up_us/p99",
         "wake-up after deadline", "p99", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::wake_up, &TimeStats::p99>},
    {"wake_up_p999_us", "/realtime/wake_up_us/p99.9",
         "wake-up after deadline", "p99.9", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::wake_up, &TimeStats::p999>},
    {"wake_up_max_us", "/realtime/wake_up_us/max",
         "wake-up after deadline", "max", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::wake_up, &TimeStats::max>},
    {"compute_p50_us", "/realtime/compute_us/p50",
         "computation", "median", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::compute, &TimeStats::p50>},
    {"compute_p99_us", "/realtime/compute_us/p99",
         "computation", "p99", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::compute, &TimeStats::p99>},
    {"compute_p999_us", "/realtime/compute_us/p99.9",
         "computation", "p99.9", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::compute, &TimeStats::p999>},
    {"compute_max_us", "/realtime/compute_us/max",
         "computation", "max", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::compute, &TimeStats::max>},
    {"total_p50_us", "/realtime/total_us/p50",
         "deadline to output", "median", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::total, &TimeStats::p50>},
    {"total_p99_us", "/realtime/total_us/p99",
         "deadline to output", "p99", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::total, &TimeStats::p99>},
    {"total_p999_us", "/realtime/total_us/p99.9",
         "deadline to output", "p99.9", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::total, &TimeStats::p999>},
    {"total_max_us", "/realtime/total_us/max",
         "deadline to output", "max", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::total, &TimeStats::max>},
    {"late_periods", "/realtime/late_periods",
         "late periods", "", "", 0, kWallClock, kCount,
         get<same, &S::run, &R::realtime, &W::late_periods>},
    {"worst_latency_us", "/realtime/worst_latency_us",
         "worst latency", "", "us", 1, kWallClock, kMeasure,
         get<us_from_s, &S::run, &R::realtime, &W::worst_latency>},

    {"planning_time_ms", "",
         "time to plan (wall clock)", "", "ms", 2, kPlanning, kMeasure, planning_time_ms},
    {"planning_time_per_block_us", "",
         "time to plan, per block", "", "us", 3, kPlanning, kMeasure, planning_time_per_block_us},
});
// clang-format on

}  // namespace

std::string Quantity::name() const {
  return statistic.empty() ? std::string(label) : fmt::format("{}, {}", label, statistic);
}

std::string Quantity::text(const std::optional<double>& value) const {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::span<const Quantity> quantities() { return kQuantities; }

const Quantity& quantity(std::string_view key) {
  const auto found = std::ranges::find(kQuantities, key, &Quantity::key);
  assert(found != kQuantities.end());
  return *found;
}

}  // namespace twin::results
