#include "studies/reproduce/published_columns.hpp"

#include <array>

#include "core/units.hpp"
#include "path/short_block.hpp"
#include "results/quantities.hpp"

namespace twin::studies::reproduce {
namespace {

using config::MachineFile;
using results::Summary;

double feedrate_mm_per_min(const Summary& s, const MachineFile& /*machine*/) {
  return units::mm_per_min_from_mm_per_s(s.audit.feedrate);
}

double critical_corner_angle_deg(const Summary& s, const MachineFile& m) {
  return units::deg_from_rad(
      path::critical_corner_angle(s.audit.feedrate, m.planning.corner_error, m.planning));
}

constexpr std::array<PublishedColumn, 4> kTable1{{
    {"blocks", "G01 blocks", "", 0, "short_blocks"},
    {"length_mm.max", "length max", "mm", 3, "block_length_max_mm"},
    {"length_mm.min", "length min", "mm", 3, "block_length_min_mm"},
    {"length_mm.mean", "length mean", "mm", 3, "block_length_mean_mm"},
}};

constexpr std::array<PublishedColumn, 7> kTable2{{
    {"feedrate_mm_per_min", "feedrate", "mm/min", 0, "", feedrate_mm_per_min},
    {"acceleration_mm_per_s2", "A_max", "mm/s^2", 0, "",
     [](const Summary&, const MachineFile& m) { return m.limits.acceleration; }},
    {"jerk_mm_per_s3", "J_max", "mm/s^3", 0, "",
     [](const Summary&, const MachineFile& m) { return m.limits.jerk; }},
    {"circular_error_mm", "circular error", "mm", 3, "",
     [](const Summary&, const MachineFile& m) { return m.planning.circular_error; }},
    {"corner_error_mm", "corner error", "mm", 3, "",
     [](const Summary&, const MachineFile& m) { return m.planning.corner_error; }},
    {"critical_corner_angle_deg", "critical corner angle", "deg", 1, "", critical_corner_angle_deg},
    {"chord_error_mm", "chord error", "mm", 3, "",
     [](const Summary&, const MachineFile& m) { return m.path.chord_error; }},
}};

constexpr std::array<PublishedColumn, 5> kTable3{{
    {"blocks_before", "blocks before", "", 0, "short_blocks"},
    {"blocks_after", "curves after", "", 0, "curves"},
    {"compression_factor", "compression", "", 2, "compression_factor"},
    {"contour_um.max", "contour max", "um", 2, "command_contour_error_max_um"},
    {"contour_um.rms", "contour RMS", "um", 2, "command_contour_error_rms_um"},
}};

constexpr std::array<PublishedColumn, 7> kTable4{{
    {"contour_um.max", "contour max", "um", 1, "contour_error_max_um"},
    {"contour_um.rms", "contour RMS", "um", 1, "contour_error_rms_um"},
    {"x_um.max", "X max", "um", 1, "x_tracking_error_max_um"},
    {"x_um.rms", "X RMS", "um", 1, "x_tracking_error_rms_um"},
    {"y_um.max", "Y max", "um", 1, "y_tracking_error_max_um"},
    {"y_um.rms", "Y RMS", "um", 1, "y_tracking_error_rms_um"},
    {"time_s", "time", "s", 3, "machining_time_s"},
}};

}  // namespace

double PublishedColumn::ours(const Summary& summary, const MachineFile& machine) const {
  return quantity.empty() ? answer(summary, machine)
                          : results::quantity(quantity).get(summary).value_or(0.0);
}

std::span<const PublishedColumn> columns_of(int table) {
  switch (table) {
    case 1:
      return kTable1;
    case 2:
      return kTable2;
    case 3:
      return kTable3;
    case 4:
    case 5:
      return kTable4;
    default:
      return {};
  }
}

}  // namespace twin::studies::reproduce
