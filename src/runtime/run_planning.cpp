#include "runtime/run_planning.hpp"

#include <algorithm>
#include <utility>

#include "runtime/run_errors.hpp"
#include "runtime/run_options.hpp"

namespace twin::runtime {
namespace {

/// Planned segments that may wait for the motion, however few the planner looks ahead. It trades
/// memory, some kilobytes each, for segments so short that fewer of them are less path than the
/// motion needs to brake on.
constexpr int kLeastWaiting = 200;

int most_waiting(const RunRequest& request) {
  return std::max(request.machine.path.look_ahead, kLeastWaiting);
}

std::size_t queue_size(const RunRequest& request) {
  return static_cast<std::size_t>(most_waiting(request));
}

}  // namespace

LockstepPlanning::LockstepPlanning(const RunRequest& request, ProgramPlanner& planner,
                                   std::atomic<bool>& stop)
    : planning_(planner, request.machine), stop_(stop) {
  planning_.before_segment = request.hooks.before_segment;
}

WallClockPlanning::WallClockPlanning(const RunRequest& request, ProgramPlanner& planner,
                                     std::atomic<bool>& stop)
    : request_(request),
      stop_(stop),
      beat_(request.machine.period),
      segments_(queue_size(request), queue_size(request) + 2),
      loop_(planner, segments_, link_, most_waiting(request)) {
  loop_.before_segment = request.hooks.before_segment;
}

std::unique_ptr<Pace> WallClockPlanning::make_pace() {
  if (request_.hal != nullptr && request_.hal->info().gives_beat) {
    return std::make_unique<BeatPace>(segments_, beat_, wall_clock_options(request_));
  }
  return std::make_unique<WallClockPace>(segments_, clock_, wall_clock_options(request_));
}

void WallClockPlanning::start() {
  thread_ = std::jthread([this] { plan(); });
}

/// Body of the planning thread: nothing escapes, and the motion thread is told the end.
void WallClockPlanning::plan() noexcept {
  try {
    if (auto planned = loop_.run(); !planned) {
      error_ = std::move(planned).error();
    }
  } catch (...) {
    error_ = thrown("planning");
  }
  if (error_) {
    stop_.store(true);
    segments_.close(SegmentQueue::kEveryPlan);
  }
}

std::optional<Error> WallClockPlanning::join() noexcept {
  if (thread_.joinable()) {
    thread_.join();
  }
  return error_;
}

}  // namespace twin::runtime
