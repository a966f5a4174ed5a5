#include "studies/compare/figure_kinds.hpp"

#include <algorithm>
#include <array>

#include "core/units.hpp"

namespace twin::studies::compare {
namespace {

using units::um_from_mm;

/// A figure that only a run on a machine has; 0 without one.
template <class Get>
double of_run(const Contestant& c, Get get) {
  return c.summary.run ? get(*c.summary.run) : 0.0;
}

using Run = results::MachineFigures;

constexpr std::array<FigureKind, 25> kFigures{{
    {"planned_time_s", "planned time", "s", 3,
     [](const Contestant& c) { return c.summary.planned_time; }},
    {"time_bound_s", "lower bound of it", "s", 3,
     [](const Contestant& c) { return c.plan.time_bound; }},
    {"bound_ratio", "planned time / bound", "", 4,
     [](const Contestant& c) { return c.summary.planned_time / c.plan.time_bound; }},
    {"machining_time_s", "machining time", "s", 3,
     [](const Contestant& c) { return of_run(c, [](const Run& r) { return r.machining_time; }); }},
    {"segments", "segments", "", 0,
     [](const Contestant& c) { return static_cast<double>(c.summary.segments.total); }},
    {"compression_factor", "compression factor", "", 2,
     [](const Contestant& c) { return c.summary.compression_factor; }},
    {"certified_deviation_um", "certified deviation", "um", 2,
     [](const Contestant& c) { return um_from_mm(c.plan.deviation); }},
    {"command_contour_error_max_um", "contour error of command, max", "um", 2,
     [](const Contestant& c) { return um_from_mm(c.summary.command_contour_error.max); }},
    {"command_contour_error_rms_um", "contour error of command, RMS", "um", 2,
     [](const Contestant& c) { return um_from_mm(c.summary.command_contour_error.rms); }},
    {"contour_error_max_um", "contour error, max", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.contour_error.max); });
     }},
    {"contour_error_rms_um", "contour error, RMS", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.contour_error.rms); });
     }},
    {"table_contour_error_max_um", "contour error of table, max", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.table_contour_error.max); });
     }},
    {"table_contour_error_rms_um", "contour error of table, RMS", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.table_contour_error.rms); });
     }},
    {"x_tracking_error_max_um", "tracking error of X, max", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.tracking_error[0].max); });
     }},
    {"x_tracking_error_rms_um", "tracking error of X, RMS", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.tracking_error[0].rms); });
     }},
    {"y_tracking_error_max_um", "tracking error of Y, max", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.tracking_error[1].max); });
     }},
    {"y_tracking_error_rms_um", "tracking error of Y, RMS", "um", 2,
     [](const Contestant& c) {
       return of_run(c, [](const Run& r) { return um_from_mm(r.tracking_error[1].rms); });
     }},
    {"feedrate_peak_mm_per_s", "feedrate, peak", "mm/s", 2,
     [](const Contestant& c) { return c.summary.audit.feedrate; },
     [](const Limits& l) { return l.feedrate; }},
    {"tangential_acceleration_peak_mm_per_s2", "tangential acceleration, peak", "mm/s^2", 0,
     [](const Contestant& c) { return c.summary.audit.tangential_acceleration; },
     [](const Limits& l) { return l.acceleration; }},
    {"normal_acceleration_peak_mm_per_s2", "normal acceleration, peak", "mm/s^2", 0,
     [](const Contestant& c) { return c.summary.audit.normal_acceleration; },
     [](const Limits& l) { return l.acceleration; }},
    {"tangential_jerk_peak_mm_per_s3", "tangential jerk, peak", "mm/s^3", 0,
     [](const Contestant& c) { return c.summary.audit.tangential_jerk; },
     [](const Limits& l) { return l.jerk; }},
    {"feedrate_fluctuation_max_percent", "feedrate fluctuation, max", "%", 4,
     [](const Contestant& c) { return 100.0 * c.summary.feedrate_fluctuation.max; }},
    {"feedrate_fluctuation_rms_percent", "feedrate fluctuation, RMS", "%", 4,
     [](const Contestant& c) { return 100.0 * c.summary.feedrate_fluctuation.rms; }},
    {"planning_time_ms", "time to plan (wall clock)", "ms", 2,
     [](const Contestant& c) { return 1e3 * c.planning_time; }},
    {"planning_time_per_block_us", "the same per block", "us", 3,
     [](const Contestant& c) {
       return 1e6 * c.planning_time /
              static_cast<double>(std::max<std::int64_t>(c.summary.blocks.total, 1));
     }},
}};

}  // namespace

std::span<const FigureKind> figure_kinds() { return kFigures; }

}  // namespace twin::studies::compare
