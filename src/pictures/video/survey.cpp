#include "pictures/video/survey.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "results/trace/columns.hpp"

namespace twin::pictures::video {
namespace {

/// Bounding box of what was seen with the pen in some state.
struct Box {
  Vec2 low = Vec2::Constant(HUGE_VAL);
  Vec2 high = Vec2::Constant(-HUGE_VAL);
  double largest_error_um = 0.0;
  double largest_rms_um = 0.0;
  bool is_empty = true;

  void add(const TraceRow& row) {
    low = low.cwiseMin(row.position.head<2>());
    high = high.cwiseMax(row.position.head<2>());
    largest_error_um = std::fmax(largest_error_um, row.error_um);
    if (row.t >= results::MovingRms::kTime) {  // it is a mean from then on
      largest_rms_um = std::fmax(largest_rms_um, row.error_rms_um);
    }
    is_empty = false;
  }
};

}  // namespace

Expected<Survey> survey_trace(const std::filesystem::path& trace_csv) {
  auto rows = TraceRows::open(trace_csv);
  if (!rows) {
    return tl::unexpected(std::move(rows.error()));
  }
  Box down;
  Box all;
  History history;
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
    const bool draws = row.position.z() <= results::kPenUp;
    if (draws) {
      down.add(row);
    }
    history.add(row, draws);
  }
  if (all.is_empty) {
    return tl::unexpected<Error>(
        Error{ErrorCode::kFile, "the trace has no rows", trace_csv.string(), 0, 0});
  }
  const Box& box = down.is_empty ? all : down;
  const double pen_up = down.is_empty ? std::numeric_limits<double>::infinity() : results::kPenUp;
  return Survey{
      row.t,  rows->has_error(), box.largest_error_um, box.largest_rms_um, box.low, box.high,
      pen_up, std::move(history)};
}

}  // namespace twin::pictures::video
