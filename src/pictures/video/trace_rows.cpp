#include "pictures/video/trace_rows.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace twin::pictures::video {
namespace {

constexpr std::size_t kOfPlan = 6;
constexpr std::size_t kOfRun = 7;  // one more: the contour error
constexpr std::size_t kAll = 9;    // two more: the set point
constexpr std::array<std::string_view, kAll> kRun{"t_s",
                                                  "line",
                                                  "x_table_mm",
                                                  "y_table_mm",
                                                  "z_cmd_mm",
                                                  "feedrate_mm_per_s",
                                                  "contour_error_um",
                                                  "x_cmd_mm",
                                                  "y_cmd_mm"};
constexpr std::array<std::string_view, kOfPlan> kPlan{"t_s",      "line",     "x_cmd_mm",
                                                      "y_cmd_mm", "z_cmd_mm", "feedrate_mm_per_s"};

}  // namespace

Expected<TraceRows> TraceRows::open(const std::filesystem::path& trace_csv) {
  auto reader = results::TraceReader::open(trace_csv);
  if (!reader) {
    return tl::unexpected(std::move(reader.error()));
  }
  const bool is_run = reader->has("x_table_mm") || reader->has("contour_error_um");
  const bool has_commanded = is_run && reader->has("x_cmd_mm") && reader->has("y_cmd_mm");
  const auto names =
      is_run ? std::span<const std::string_view>(kRun).first(has_commanded ? kAll : kOfRun)
             : std::span<const std::string_view>(kPlan);
  if (auto chosen = reader->select(names); !chosen) {
    return tl::unexpected(std::move(chosen.error()));
  }
  TraceRows rows(std::move(*reader));
  rows.zero_ = results::ProgramZero::beside(trace_csv);
  rows.has_error_ = is_run;
  rows.has_commanded_ = has_commanded;
  return rows;
}

Expected<bool> TraceRows::next(TraceRow& row) {
  std::array<double, kAll> v{};
  auto got = reader_.next(std::span(v).first(has_commanded_ ? kAll
                                             : has_error_   ? kOfRun
                                                            : kOfPlan));
  if (got && *got) {
    row = {v[0],        v[1], {v[2], v[3], v[4] - zero_.at(v[0])},
           v[5],        v[6], rms_.push(v[0], v[6]),
           {v[2], v[3]}};
    if (has_commanded_) {
      row.commanded = {v[7], v[8]};
    }
  }
  return got;
}

}  // namespace twin::pictures::video
