#include "pictures/plot/figure_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "pictures/plot/gnuplot.hpp"
#include "pictures/plot/motion_filter.hpp"
#include "pictures/plot/normal_error.hpp"
#include "results/metrics/moving_rms.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/decimator.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::pictures {
namespace {

constexpr std::size_t kMaxRows = 12000;  // of a figure's data

/// Fields of a record: first the columns that are read from the trace, those of a plan in front;
/// then what is derived.
enum Field : std::size_t {
  kT,
  kX,
  kY,
  kZ,
  kFeedrate,
  kEncX,
  kEncY,
  kContour,
  kTrackX,
  kTrackY,
  kAcceleration,
  kJerk,
  kErrorX,
  kErrorY,
  kRms,
  kPenHeight,
  kFields
};
constexpr std::size_t kPlanInputs = kFeedrate + 1;
constexpr std::size_t kRunInputs = kTrackY + 1;
constexpr std::array<std::string_view, kFields> kFieldNames{"t_s",
                                                            "x_cmd_mm",
                                                            "y_cmd_mm",
                                                            "z_cmd_mm",
                                                            "feedrate_mm_per_s",
                                                            "x_enc_mm",
                                                            "y_enc_mm",
                                                            "contour_error_um",
                                                            "x_tracking_error_um",
                                                            "y_tracking_error_um",
                                                            "acceleration_mm_per_s2",
                                                            "jerk_mm_per_s3",
                                                            "x_error_um",
                                                            "y_error_um",
                                                            "contour_error_rms_um",
                                                            "pen_height_mm"};

using Record = std::array<double, kFields>;

/// The data of one figure: some fields of the records, thinned.
class FigureTable {
 public:
  FigureTable(std::string name, std::vector<std::size_t> fields)
      : name_(std::move(name)),
        fields_(std::move(fields)),
        row_(fields_.size()),
        decimator_(fields_.size(), watched(), kMaxRows) {}

  void push(const Record& record) {
    std::ranges::transform(fields_, row_.begin(), [&](std::size_t field) { return record[field]; });
    decimator_.push(row_);
  }

  Expected<void> save(const std::filesystem::path& folder) {
    std::vector<std::string_view> names(fields_.size());
    std::ranges::transform(fields_, names.begin(), [](std::size_t f) { return kFieldNames[f]; });
    return write_table(folder, name_, names, decimator_.finish());
  }

 private:
  std::vector<std::size_t> watched() const {  // all but time and height
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (fields_[i] != kT && fields_[i] != kPenHeight) {
        result.push_back(i);
      }
    }
    return result;
  }

  std::string name_;
  std::vector<std::size_t> fields_;
  std::vector<double> row_;
  results::Decimator decimator_;
};

std::vector<FigureTable> tables_of(bool plan_only) {
  std::vector<FigureTable> tables;
  tables.emplace_back("feedrate", std::vector<std::size_t>{kT, kFeedrate});
  tables.emplace_back("acceleration_jerk", std::vector<std::size_t>{kT, kAcceleration, kJerk});
  if (plan_only) {
    tables.emplace_back("contour", std::vector<std::size_t>{kX, kY, kPenHeight});
    return tables;
  }
  tables.emplace_back("contour", std::vector<std::size_t>{kX, kY, kPenHeight, kEncX, kEncY, kRms});
  tables.emplace_back("contour_magnified",
                      std::vector<std::size_t>{kX, kY, kPenHeight, kErrorX, kErrorY});
  tables.emplace_back("contour_error", std::vector<std::size_t>{kT, kContour, kRms});
  tables.emplace_back("tracking_errors", std::vector<std::size_t>{kT, kTrackX, kTrackY});
  return tables;
}

/// Turns rows of the trace into records, which come out some rows later, and hands them to the
/// tables.
class Stream {
 public:
  Stream(const results::ProgramZero& zero, bool plan_only)
      : zero_(zero), plan_only_(plan_only), tables_(tables_of(plan_only)) {}

  /// @returns false when time does not ascend
  bool push(const Record& record) {
    if (!pending_.empty() && record[kT] <= pending_.back()[kT]) {
      return false;
    }
    pending_.push_back(record);
    if (!motion_ && pending_.size() == 2) {
      motion_.emplace(pending_[1][kT] - pending_[0][kT]);
      advance(pending_[0]);
      last_ = pending_[0];
    }
    if (motion_) {
      advance(record);
    }
    return true;
  }

  Expected<DataSummary> finish(const std::filesystem::path& folder) {
    if (!motion_) {
      return fail(ErrorCode::kFile, "a trace of fewer than two rows has no figures");
    }
    for (const Record end = pending_.back(); !pending_.empty();) {
      advance(end);  // at rest after the last set point
    }
    for (FigureTable& table : tables_) {
      TWIN_CHECK(table.save(folder));
    }
    summary_.extent = high_ - low_;
    summary_.has_pen_up = lifted_ && lowered_;
    return summary_;
  }

 private:
  void advance(const Record& newest) {
    const auto motion = motion_->push({newest[kX], newest[kY], newest[kZ]}, newest[kFeedrate]);
    if (!motion) {
      return;
    }
    Record record = pending_.front();
    const Record& next = pending_.size() > 1 ? pending_[1] : record;
    record[kAcceleration] = motion->acceleration;
    record[kJerk] = motion->jerk;
    record[kPenHeight] = record[kZ] - zero_.at(record[kT]);
    const Vec2 here(record[kX], record[kY]);
    if (!plan_only_) {
      const Vec2 error = normal_error({last_[kX], last_[kY]}, here, {next[kX], next[kY]},
                                      {record[kEncX], record[kEncY]});
      record[kErrorX] = units::um_from_mm(error.x());
      record[kErrorY] = units::um_from_mm(error.y());
      summary_.largest_error_um =
          std::max(summary_.largest_error_um, units::um_from_mm(error.norm()));
      record[kRms] = rms_.push(record[kT], record[kContour]);
      if (record[kContour] > summary_.worst_um && record[kPenHeight] <= results::kPenUp) {
        summary_.worst_um = record[kContour];
        summary_.worst_at = {record[kEncX], record[kEncY]};
      }
    }
    low_ = low_.cwiseMin(here);
    high_ = high_.cwiseMax(here);
    (record[kPenHeight] > results::kPenUp ? lifted_ : lowered_) = true;
    for (FigureTable& table : tables_) {
      table.push(record);
    }
    last_ = record;
    pending_.pop_front();
  }

  const results::ProgramZero& zero_;
  bool plan_only_;
  std::vector<FigureTable> tables_;
  results::MovingRms rms_;
  std::deque<Record> pending_;  // records whose motion is not known yet
  std::optional<MotionFilter> motion_;
  Record last_{};  // the record before pending_.front()
  DataSummary summary_;
  Vec2 low_ = Vec2::Constant(HUGE_VAL);
  Vec2 high_ = Vec2::Constant(-HUGE_VAL);
  bool lifted_ = false;
  bool lowered_ = false;
};

Expected<void> save_programmed(const std::filesystem::path& folder, std::span<const Vec2> path) {
  constexpr std::array<std::string_view, 2> names{"x_mm", "y_mm"};
  results::Decimator decimator(2, {0, 1}, kMaxRows);
  for (const Vec2& point : path) {
    decimator.push({point.data(), 2});
  }
  return write_table(folder, "contour_programmed", names, decimator.finish());
}

}  // namespace

Expected<DataSummary> write_figure_data(const std::filesystem::path& trace,
                                        const std::filesystem::path& folder,
                                        std::span<const Vec2> programmed,
                                        const results::ProgramZero& zero, bool plan_only) {
  TWIN_TRY(results::TraceReader reader, results::TraceReader::open(trace));
  const std::size_t inputs = plan_only ? kPlanInputs : kRunInputs;
  TWIN_CHECK(reader.select(std::span(kFieldNames).first(inputs)));
  Stream stream(zero, plan_only);
  Record record{};
  for (;;) {
    TWIN_TRY(const bool has_row, reader.next(std::span(record).first(inputs)));
    if (!has_row) {
      break;
    }
    if (!stream.push(record)) {
      return reader.wrong_row(fmt::format("t_s {} s does not ascend", record[kT]));
    }
  }
  auto summary = stream.finish(folder);
  if (!summary) {
    summary.error().file = summary.error().file.empty() ? trace.string() : summary.error().file;
    return summary;
  }
  if (!programmed.empty()) {
    TWIN_CHECK(save_programmed(folder, programmed));
  }
  summary->has_programmed = !programmed.empty();
  summary->has_limit = std::filesystem::exists(folder / results::kLimitName);
  return summary;
}

}  // namespace twin::pictures
