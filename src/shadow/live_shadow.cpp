#include "shadow/live_shadow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <string_view>

namespace twin::shadow {
namespace {

constexpr std::array<std::string_view, 8> kNeeded{
    "t_s", "line", "x_enc_mm", "x_drive_V", "x_table_mm", "y_enc_mm", "y_drive_V", "y_table_mm"};

double thread_cpu_time() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

LiveShadow::LiveShadow(const config::MachineFile& machine, Baseline baseline, bool gives,
                       LiveOptions options)
    : machine_(machine),
      baseline_(std::move(baseline)),
      gives_(gives),
      options_(std::move(options)) {}

LiveShadow::~LiveShadow() { end(); }

std::optional<Error> LiveShadow::find_columns(const TraceHeader& header) {
  width_ = header.columns.size();
  for (const std::string_view name : kNeeded) {
    const auto at = std::ranges::find(header.columns, name, &TraceColumn::name);
    if (at == header.columns.end()) {
      return Error{ErrorCode::kUsage,
                   fmt::format("a shadow needs the column {} of the trace: leave out --columns, or "
                               "name it",
                               name),
                   {},
                   0,
                   0};
    }
    columns_.push_back(static_cast<std::size_t>(at - header.columns.begin()));
  }
  return std::nullopt;
}

std::optional<Error> LiveShadow::begin(const TraceHeader& header) {
  if (auto error = find_columns(header)) {
    return error;
  }
  Recorded recorded;
  recorded.has_scale = machine_.shadow.has_scale;
  shadow_ = std::make_unique<Shadow>(machine_, baseline_, gives_, machine_.shadow.hours,
                                     std::array{recorded, recorded});
  thread_ = std::jthread([this] { watch(); });
  return std::nullopt;
}

ShadowSample LiveShadow::sample_of(const double* row) const noexcept {
  const auto at = [&](std::size_t i) { return row[columns_[i]]; };
  ShadowSample sample{.time = at(0), .line = static_cast<std::int64_t>(at(1)), .axis = {}};
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    const std::size_t first = 2 + 3 * axis;
    sample.axis[axis] = {.measured = at(first), .volts = at(first + 1)};
    sample.axis[axis].scale = at(first + 2);
  }
  return sample;
}

/// In the shadow's thread: one row.
void LiveShadow::take(const ShadowSample& sample) {
  if (is_off_) {
    return;
  }
  ++watched_;
  const bool is_new = shadow_->step(sample);
  if (!is_new && !shadow_->has_failed()) {
    return;
  }
  const std::scoped_lock lock(mutex_);
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const AxisShadow* const one = shadow_->axis(axis);
    if (is_new && one != nullptr && one->finding() && one->finding()->found.time == sample.time) {
      news_.push_back(to_line(*one->finding(), axis));
    }
  }
  is_off_ = is_off_ || shadow_->has_failed();
  has_news_ = true;
}

/// Body of the shadow's thread.
void LiveShadow::watch() {
  ShadowSample sample;
  std::int64_t done = 0;
  for (;;) {
    const std::uint32_t seen = pushed_.load();
    bool is_empty = true;
    for (; queue_.pop(sample); ++done) {
      is_empty = false;
      try {
        take(sample);
      } catch (...) {  // there is no memory
        is_off_ = has_news_ = true;
      }
    }
    done_ = done;
    popped_.fetch_add(1);
    popped_.notify_one();
    if (is_empty && is_closed_) {
      break;
    }
    if (is_empty) {
      pushed_.wait(seen);
    }
  }
  cpu_time_ = thread_cpu_time();
}

void LiveShadow::switch_off(std::string why) {
  is_off_ = true;
  why_off_ = std::move(why);
  if (options_.tell) {
    options_.tell("the shadow is switched off, the run goes on: " + why_off_);
  }
}

std::optional<Error> LiveShadow::tell_news() {
  if (!has_news_.exchange(false)) {
    return std::nullopt;
  }
  std::vector<std::string> news;
  {
    const std::scoped_lock lock(mutex_);
    news.swap(news_);
  }
  if (news.empty() && is_off_ && why_off_.empty()) {
    switch_off(shadow_->has_failed() ? "its model is not finite any more"
                                     : "there is not enough memory");
  }
  for (const std::string& line : news) {
    if (machine_.shadow.stops) {
      return Error{ErrorCode::kMachine, "the shadow ends the run: " + line, {}, 0, 0};
    }
    if (options_.tell) {
      options_.tell("shadow: " + line);
    }
  }
  return std::nullopt;
}

std::optional<Error> LiveShadow::rows(std::span<const double> values) {
  for (std::size_t at = 0; at + width_ <= values.size() && !is_off_; at += width_) {
    const ShadowSample sample = sample_of(values.data() + at);
    last_time_ = sample.time;
    for (std::uint32_t seen = popped_.load(); !queue_.push(sample); seen = popped_.load()) {
      if (options_.is_wall_clock) {
        switch_off(fmt::format("it fell behind by {} periods at {:.3f} s", kQueue, sample.time));
        break;
      }
      pushed_.fetch_add(1);
      pushed_.notify_one();
      popped_.wait(seen);
    }
    sent_ += is_off_ ? 0 : 1;
  }
  pushed_.fetch_add(1);
  pushed_.notify_one();
  if (!options_.is_wall_clock && machine_.shadow.stops) {
    // A finding ends the run at the same period whichever thread is faster.
    for (std::uint32_t seen = popped_.load(); done_.load() < sent_ && !is_off_;
         seen = popped_.load()) {
      popped_.wait(seen);
    }
  }
  return tell_news();
}

void LiveShadow::end() noexcept {
  if (!thread_.joinable()) {
    return;
  }
  is_closed_ = true;
  pushed_.fetch_add(1);
  pushed_.notify_one();
  thread_.join();
  report_ = make_report(*shadow_, baseline_, machine_);
  report_.switched_off = why_off_;
  report_.periods = watched_;
  report_.cost = watched_ > 0 ? cpu_time_ / static_cast<double>(watched_) : 0.0;
}

std::optional<Error> LiveShadow::commit() {
  end();
  return tell_news();
}

void LiveShadow::abandon() noexcept {
  end();
  try {
    static_cast<void>(tell_news());
  } catch (...) {  // what cannot be told is in the report
  }
}

Expected<std::unique_ptr<LiveShadow>> make_live_shadow(const config::MachineFile& machine,
                                                       const std::filesystem::path& learnt,
                                                       LiveOptions options) {
  TWIN_TRY(const bool gives, screws_give(machine));
  Recorded recorded;
  recorded.has_scale = machine.shadow.has_scale;
  TWIN_TRY(Baseline baseline, baseline_of(machine, learnt, gives, {recorded, recorded}));
  return std::make_unique<LiveShadow>(machine, std::move(baseline), gives, std::move(options));
}

}  // namespace twin::shadow
