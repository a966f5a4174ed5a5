#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/rounded.hpp"
#include "core/units.hpp"
#include "results/metrics/summary.hpp"

namespace twin::results {
namespace {

using Json = nlohmann::ordered_json;

// Nine significant digits: picometres in a path of metres, and no 0.30000000000000004.
Json error_um(const ErrorFigures& error) {
  return {{"max", rounded(units::um_from_mm(error.max))},
          {"rms", rounded(units::um_from_mm(error.rms))}};
}

Json blocks_of(const BlockFigures& blocks) {
  return {{"total", blocks.total},
          {"short", blocks.short_blocks},
          {"length_mm",
           {{"min", rounded(blocks.length_min)},
            {"mean", rounded(blocks.length_mean)},
            {"max", rounded(blocks.length_max)}}}};
}

Json segments_of(const SegmentFigures& segments, const std::optional<CertifiedFigures>& certified) {
  Json json = {{"total", segments.total},
               {"curves", segments.curves},
               {"lines", segments.lines},
               {"arcs", segments.arcs}};
  if (certified) {
    json["spans"] = certified->spans;
  }
  return json;
}

Json audit_of(const AuditPeaks& audit) {
  Json axes;
  for (std::size_t i = 0; i < audit.axis.size(); ++i) {
    axes[std::string(1, "xyz"[i])] = {
        {"velocity_mm_per_s", rounded(audit.axis[i].velocity)},
        {"acceleration_mm_per_s2", rounded(audit.axis[i].acceleration)},
        {"jerk_mm_per_s3", rounded(audit.axis[i].jerk)}};
  }
  return {{"feedrate_mm_per_s", rounded(audit.feedrate)},
          {"tangential_acceleration_mm_per_s2", rounded(audit.tangential_acceleration)},
          {"tangential_jerk_mm_per_s3", rounded(audit.tangential_jerk)},
          {"normal_acceleration_mm_per_s2", rounded(audit.normal_acceleration)},
          {"axis", axes}};
}

Json overrides_of(const std::vector<OverrideRecord>& overrides) {
  Json list = Json::array();
  for (const OverrideRecord& change : overrides) {
    list.push_back({{"asked_at_s", rounded(change.asked_at)},
                    {"percent", rounded(change.percent)},
                    {"from_s", rounded(change.from)}});
  }
  return list;
}

Json cycle_time_us(const CycleTimes& times) {
  return {{"p50", rounded(times.p50 * 1e6)},
          {"p99", rounded(times.p99 * 1e6)},
          {"max", rounded(times.max * 1e6)}};
}

Json time_us(const TimeFigures& times) {
  return {{"p50", rounded(times.p50 * 1e6)},
          {"p99", rounded(times.p99 * 1e6)},
          {"p99.9", rounded(times.p999 * 1e6)},
          {"max", rounded(times.max * 1e6)}};
}

Json realtime_of(const RealTimeFigures& realtime) {
  return {{"wake_up_us", time_us(realtime.wake_up)},
          {"compute_us", time_us(realtime.compute)},
          {"total_us", time_us(realtime.total)},
          {"late_periods", realtime.late_periods},
          {"worst_latency_us", rounded(realtime.worst_latency * 1e6)},
          {"notes", realtime.notes}};
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json;
  json["program"] = summary.program;
  json["machine"] = summary.machine;
  json["hal"] = summary.hal;
  json["interpolator"] = summary.interpolator;
  json["simulated"] = summary.simulated;
  json["period_s"] = rounded(summary.period);
  json["blocks"] = blocks_of(summary.blocks);
  json["segments"] = segments_of(summary.segments, summary.certified);
  json["compression_factor"] = rounded(summary.compression_factor);
  json["path_length_mm"] = rounded(summary.path_length);
  json["planned_time_s"] = rounded(summary.planned_time);
  if (summary.time_bound) {
    json["time_bound_s"] = rounded(*summary.time_bound);
    json["bound_ratio"] = rounded(summary.planned_time / *summary.time_bound);
  }
  if (summary.run) {
    json["machining_time_s"] = rounded(summary.run->machining_time);
  }
  if (summary.certified) {
    json["certified_deviation_um"] = rounded(units::um_from_mm(summary.certified->deviation));
  }
  if (!summary.overrides.empty()) {
    json["override"] = overrides_of(summary.overrides);
  }
  json["command_contour_error_um"] = error_um(summary.command_contour_error);
  if (summary.run) {
    json["contour_error_um"] = error_um(summary.run->contour_error);
    json["table_contour_error_um"] = error_um(summary.run->table_contour_error);
    json["tracking_error_um"] = {{"x", error_um(summary.run->tracking_error[0])},
                                 {"y", error_um(summary.run->tracking_error[1])}};
  }
  json["feedrate_fluctuation_percent"] = {{"max", rounded(1e2 * summary.feedrate_fluctuation.max)},
                                          {"rms", rounded(1e2 * summary.feedrate_fluctuation.rms)}};
  json["audit"] = audit_of(summary.audit);
  if (summary.run) {
    json["cycle_time_us"] = cycle_time_us(summary.run->cycle_time);
    json["real_time_factor"] = rounded(summary.run->real_time_factor);
    if (summary.run->realtime) {
      json["realtime"] = realtime_of(*summary.run->realtime);
    }
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace twin::results
