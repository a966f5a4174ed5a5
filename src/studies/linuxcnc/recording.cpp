#include "studies/linuxcnc/recording.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "hal/machine.hpp"

namespace twin::studies::linuxcnc {
namespace {

constexpr double kBefore = 0.333;             // of a recording [s]
constexpr std::size_t kValuesAtOnce = 20000;  // handed to the file

}  // namespace

results::Sample sample_of(const twin_segment& memory) noexcept {
  results::Sample sample;
  sample.line = memory.line;
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const twin_axis& axis = memory.axis[i];
    sample.encoder[k] =
        static_cast<double>(axis.feedback.counts) * axis.mm_per_count - axis.command.offset;
    sample.table[k] = axis.feedback.table_position - axis.command.offset;
    sample.command[k] = axis.command.is_recorded != 0 ? axis.command.position : sample.encoder[k];
    sample.volts[k] = axis.command.volts;
    sample.torque[k] = axis.feedback.torque;
    sample.friction[k] = axis.feedback.friction;
  }
  const twin_axis& pen = memory.axis[hal::kServoAxes];
  sample.command.z() = pen.command.position - pen.command.offset;
  return sample;
}

results::ColumnChoice recording_columns() {
  return *results::choose_columns(
      "t_s,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s,x_enc_mm,y_enc_mm,x_table_mm,"
      "y_table_mm,x_drive_V,y_drive_V,x_tracking_error_um,y_tracking_error_um,x_torque_Nm,"
      "y_torque_Nm,x_friction_N,y_friction_N",
      results::Layout::kRun, true);
}

Recordings::Recordings(std::filesystem::path folder, double period)
    : folder_(std::move(folder)), period_(period), columns_(recording_columns()) {}

/// Keeps the last rest of the set point, and what came after it.
void Recordings::forget_earlier_motion() {
  const auto stands = [this](std::size_t i) {
    return (before_[i].command - before_[i - 1].command).norm() <= 0.0;
  };
  std::size_t first = before_.empty() ? 0 : before_.size() - 1;
  while (first > 0 && !stands(first)) {
    --first;
  }
  while (first > 0 && stands(first)) {
    --first;
  }
  before_.erase(before_.begin(), before_.begin() + static_cast<std::ptrdiff_t>(first));
}

Expected<void> Recordings::begin() {
  forget_earlier_motion();
  current_ = folder_ / fmt::format("{:03}", folders_.size() + 1);
  std::error_code error;
  std::filesystem::create_directories(current_, error);
  if (error) {
    return file_error(current_, "make this folder", error.value());
  }
  trace_.emplace(current_, Durability::kCached);
  TWIN_CHECK(checked(trace_->begin(results::trace_header(columns_, period_))));
  written_ = 0;
  for (const results::Sample& sample : before_) {
    TWIN_CHECK(write(sample));
  }
  before_.clear();
  return {};
}

Expected<void> Recordings::write(const results::Sample& sample) {
  results::Sample row = sample;
  row.t = static_cast<double>(written_) * period_;
  row.feedrate = written_ > 0 ? (row.command - last_).norm() / period_ : 0.0;
  last_ = row.command;
  ++written_;
  results::append_row(row, {}, columns_, rows_);
  return rows_.size() >= kValuesAtOnce ? flush() : Expected<void>();
}

Expected<void> Recordings::flush() {
  if (!rows_.empty()) {
    TWIN_CHECK(checked(trace_->rows(rows_)));
    rows_.clear();
  }
  return {};
}

Expected<void> Recordings::take(const twin_segment& memory) {
  const results::Sample sample = sample_of(memory);
  if (memory.is_recording == 0) {
    TWIN_CHECK(end());
    before_.push_back(sample);
    if (static_cast<double>(before_.size()) * period_ > kBefore) {
      before_.pop_front();
    }
    return {};
  }
  if (!trace_) {
    TWIN_CHECK(begin());
  }
  return write(sample);
}

Expected<void> Recordings::end() {
  if (!trace_) {
    return {};
  }
  TWIN_CHECK(flush());
  TWIN_CHECK(checked(trace_->commit()));
  trace_.reset();
  folders_.push_back(current_);
  return {};
}

}  // namespace twin::studies::linuxcnc
