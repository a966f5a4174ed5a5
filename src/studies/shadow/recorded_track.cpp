#include "studies/shadow/recorded_track.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "core/units.hpp"
#include "results/trace/trace_reader.hpp"
#include "studies/identify/recording.hpp"

namespace twin::studies::shadow {
namespace {

using identify::AxisSignals;
using identify::Quantity;
using twin::shadow::ShadowSample;
using twin::shadow::Track;

constexpr double kSamePeriod = 1e-3;  // relative

/// Volts for one unit of the recorded drive command.
double volts_per_unit(const AxisSignals& signals, const hal::mujoco::AxisParams& params) {
  switch (signals.volts_in) {
    case Quantity::kSpeed:
      return 1.0 / params.mm_per_s_per_volt();
    case Quantity::kRotationSpeed:
      return 1.0 / params.drive.vref_scale_rpm_per_V;
    default:
      return 1.0;
  }
}

void take_axis(const AxisSignals& signals, const config::MachineFile& machine, hal::Axis axis,
               Track& track) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const double volts = volts_per_unit(signals, params);
  const double force =
      signals.force_in == Quantity::kTorque ? 1.0 / units::m_from_mm(params.mm_per_rad()) : 1.0;
  track.is_recorded[axis] = signals.is_recorded();
  track.recorded[axis].has_volts = !signals.volts.empty();
  track.recorded[axis].has_force = !signals.force.empty();
  for (std::size_t k = 0; k < track.samples.size() && track.is_recorded[axis]; ++k) {
    auto& sample = track.samples[k].axis[axis];
    sample.measured = signals.measured[k];
    sample.volts = signals.volts.empty() ? 0.0 : volts * signals.volts[k];
    sample.force = signals.force.empty() ? 0.0 : force * signals.force[k];
  }
}

/// Lines of the program and the table's position, of the traces of this program.
Expected<void> take_more(const std::filesystem::path& file, bool has_scale,
                         std::vector<Track>& tracks, const std::vector<std::size_t>& first_rows) {
  TWIN_TRY(results::TraceReader reader, results::TraceReader::open(file));
  const bool has_lines = reader.has("line");
  const bool has_table = has_scale && reader.has("x_table_mm") && reader.has("y_table_mm");
  if (has_scale && !has_table) {
    return tl::unexpected(Error{ErrorCode::kFile,
                                "shadow.scale = true needs the columns x_table_mm and y_table_mm",
                                file.string(), 0, 0});
  }
  std::vector<std::string_view> names;
  if (has_lines) {
    names.emplace_back("line");
  }
  if (has_table) {
    names.emplace_back("x_table_mm");
    names.emplace_back("y_table_mm");
  }
  if (names.empty()) {
    return {};
  }
  TWIN_CHECK(reader.select(names));
  std::size_t row = 0;
  std::size_t at = 0;
  return reader.for_each_row([&](std::span<const double> values) {
    while (at + 1 < tracks.size() && row >= first_rows[at + 1]) {
      ++at;
    }
    if (row >= first_rows[at] && row - first_rows[at] < tracks[at].samples.size()) {
      ShadowSample& sample = tracks[at].samples[row - first_rows[at]];
      sample.line = has_lines ? static_cast<std::int64_t>(values[0]) : 0;
      for (const hal::Axis axis : {hal::kX, hal::kY}) {
        sample.axis[axis].scale = has_table ? values[(has_lines ? 1 : 0) + axis] : 0.0;
        tracks[at].recorded[axis].has_scale = has_table;
      }
    }
    ++row;
  });
}

}  // namespace

Expected<std::vector<Track>> read_tracks(const std::filesystem::path& file,
                                         const identify::ColumnMap& columns,
                                         const config::MachineFile& machine) {
  TWIN_TRY(const auto recordings, identify::read_recordings(file, columns, machine.limits));
  std::vector<Track> tracks;
  std::vector<std::size_t> first_rows;
  for (const identify::Recording& recording : recordings) {
    if (std::abs(recording.period - machine.period) > kSamePeriod * machine.period) {
      return tl::unexpected(
          Error{ErrorCode::kFile,
                fmt::format("it has a row every {:g} ms, and interpolator.period_ms of the machine "
                            "file is {:g}; a shadow needs both to be the same",
                            1e3 * recording.period, 1e3 * machine.period),
                file.string(), 0, 0});
    }
    Track track;
    track.name = file.string();
    track.samples.resize(recording.rows);
    for (std::size_t k = 0; k < recording.rows; ++k) {
      track.samples[k].time = static_cast<double>(recording.first_row + k) * recording.period;
    }
    for (const hal::Axis axis : {hal::kX, hal::kY}) {
      take_axis(recording.axis[axis], machine, axis, track);
    }
    tracks.push_back(std::move(track));
    first_rows.push_back(recording.first_row);
  }
  TWIN_CHECK(take_more(file, machine.shadow.has_scale, tracks, first_rows));
  return tracks;
}

}  // namespace twin::studies::shadow
