#include "studies/reproduce/figure_kinds.hpp"

#include <array>

#include "core/units.hpp"
#include "path/short_block.hpp"

namespace twin::studies::reproduce {
namespace {

using config::MachineFile;
using results::Summary;
using units::um_from_mm;

double critical_corner_angle_deg(const Summary& s, const MachineFile& m) {
  return units::deg_from_rad(
      path::critical_corner_angle(s.audit.feedrate, m.planning.corner_error, m.planning));
}

constexpr std::array<FigureKind, 4> kTable1{{
    {"blocks", "G01 blocks", "", 0,
     [](const Summary& s, const MachineFile&) {
       return static_cast<double>(s.blocks.short_blocks);
     }},
    {"length_mm.max", "length max", "mm", 3,
     [](const Summary& s, const MachineFile&) { return s.blocks.length_max; }},
    {"length_mm.min", "length min", "mm", 3,
     [](const Summary& s, const MachineFile&) { return s.blocks.length_min; }},
    {"length_mm.mean", "length mean", "mm", 3,
     [](const Summary& s, const MachineFile&) { return s.blocks.length_mean; }},
}};

constexpr std::array<FigureKind, 7> kTable2{{
    {"feedrate_mm_per_min", "feedrate", "mm/min", 0,
     [](const Summary& s, const MachineFile&) {
       return units::mm_per_min_from_mm_per_s(s.audit.feedrate);
     }},
    {"acceleration_mm_per_s2", "A_max", "mm/s^2", 0,
     [](const Summary&, const MachineFile& m) { return m.limits.acceleration; }},
    {"jerk_mm_per_s3", "J_max", "mm/s^3", 0,
     [](const Summary&, const MachineFile& m) { return m.limits.jerk; }},
    {"circular_error_mm", "circular error", "mm", 3,
     [](const Summary&, const MachineFile& m) { return m.planning.circular_error; }},
    {"corner_error_mm", "corner error", "mm", 3,
     [](const Summary&, const MachineFile& m) { return m.planning.corner_error; }},
    {"critical_corner_angle_deg", "critical corner angle", "deg", 1, critical_corner_angle_deg},
    {"chord_error_mm", "chord error", "mm", 3,
     [](const Summary&, const MachineFile& m) { return m.path.chord_error; }},
}};

constexpr std::array<FigureKind, 5> kTable3{{
    {"blocks_before", "blocks before", "", 0,
     [](const Summary& s, const MachineFile&) {
       return static_cast<double>(s.blocks.short_blocks);
     }},
    {"blocks_after", "curves after", "", 0,
     [](const Summary& s, const MachineFile&) { return static_cast<double>(s.segments.curves); }},
    {"compression_factor", "compression", "", 2,
     [](const Summary& s, const MachineFile&) { return s.compression_factor; }},
    {"contour_um.max", "contour max", "um", 2,
     [](const Summary& s, const MachineFile&) { return um_from_mm(s.command_contour_error.max); }},
    {"contour_um.rms", "contour RMS", "um", 2,
     [](const Summary& s, const MachineFile&) { return um_from_mm(s.command_contour_error.rms); }},
}};

/// A figure that only a run on a machine has; 0 without one.
template <class Get>
double of_run(const Summary& s, Get get) {
  return s.run ? get(*s.run) : 0.0;
}

using Run = results::MachineFigures;

constexpr std::array<FigureKind, 7> kTable4{{
    {"contour_um.max", "contour max", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.contour_error.max); });
     }},
    {"contour_um.rms", "contour RMS", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.contour_error.rms); });
     }},
    {"x_um.max", "X max", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.tracking_error[0].max); });
     }},
    {"x_um.rms", "X RMS", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.tracking_error[0].rms); });
     }},
    {"y_um.max", "Y max", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.tracking_error[1].max); });
     }},
    {"y_um.rms", "Y RMS", "um", 1,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return um_from_mm(r.tracking_error[1].rms); });
     }},
    {"time_s", "time", "s", 3,
     [](const Summary& s, const MachineFile&) {
       return of_run(s, [](const Run& r) { return r.machining_time; });
     }},
}};

}  // namespace

std::span<const FigureKind> columns_of(int table) {
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
