#include "pictures/video/trace_rows.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "results/trace/columns.hpp"

namespace twin::pictures::video {
namespace {

constexpr std::size_t kColumns = 7;
using Names = std::array<std::string_view, kColumns>;
constexpr Names kRun{
    "t_s", "line", "x_table_mm", "y_table_mm", "z_cmd_mm", "feedrate_mm_per_s", "contour_error_um"};
constexpr Names kPlan{"t_s", "line", "x_cmd_mm", "y_cmd_mm", "z_cmd_mm", "feedrate_mm_per_s", ""};

/// Bounding box of what was seen with the pen in some state.
struct Box {
  Vec2 low = Vec2::Constant(HUGE_VAL);
  Vec2 high = Vec2::Constant(-HUGE_VAL);
  double largest_error_um = 0.0;
  bool is_empty = true;

  void add(const TraceRow& row) {
    low = low.cwiseMin(row.position.head<2>());
    high = high.cwiseMax(row.position.head<2>());
    largest_error_um = std::fmax(largest_error_um, row.error_um);
    is_empty = false;
  }
};

}  // namespace

Expected<TraceRows> TraceRows::open(const std::filesystem::path& trace_csv) {
  auto reader = results::TraceReader::open(trace_csv);
  if (!reader) {
    return tl::unexpected(std::move(reader.error()));
  }
  const bool is_run = reader->has("x_table_mm") || reader->has("contour_error_um");
  const auto names = is_run ? std::span<const std::string_view>(kRun)
                            : std::span<const std::string_view>(kPlan).first(kColumns - 1);
  if (auto chosen = reader->select(names); !chosen) {
    return tl::unexpected(std::move(chosen.error()));
  }
  TraceRows rows(std::move(*reader));
  rows.has_error_ = is_run;
  return rows;
}

Expected<bool> TraceRows::next(TraceRow& row) {
  std::array<double, kColumns> v{};
  auto got = reader_.next(std::span(v).first(has_error_ ? kColumns : kColumns - 1));
  if (got && *got) {
    row = {v[0], v[1], {v[2], v[3], v[4]}, v[5], v[6]};
  }
  return got;
}

Expected<Survey> survey_trace(const std::filesystem::path& trace_csv) {
  auto rows = TraceRows::open(trace_csv);
  if (!rows) {
    return tl::unexpected(std::move(rows.error()));
  }
  Box down;
  Box all;
  TraceRow row;
  for (;;) {
    const auto got = rows->next(row);
    if (!got) {
      return tl::unexpected(got.error());
    }
    if (!*got) {
      break;
    }
    all.add(row);
    if (row.position.z() <= results::kPenUp) {
      down.add(row);
    }
  }
  if (all.is_empty) {
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "the trace has no rows", trace_csv.string(), 0, 0});
  }
  const Box& box = down.is_empty ? all : down;
  const double pen_up = down.is_empty ? std::numeric_limits<double>::infinity() : results::kPenUp;
  return Survey{row.t, rows->has_error(), box.largest_error_um, box.low, box.high, pen_up};
}

}  // namespace twin::pictures::video
