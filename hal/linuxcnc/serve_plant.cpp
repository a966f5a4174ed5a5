#include "hal/linuxcnc/serve_plant.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "core/wall_clock.hpp"
#include "hal/linuxcnc/shared_segment.hpp"

namespace twin::hal::linuxcnc {
namespace {

constexpr std::int64_t kPatience = 20'000'000;    // between two looks at `stop` [ns]
constexpr std::int64_t kShimCheck = 100'000'000;  // between looks whether the component lives [ns]

/// A plant at work.
class PlantServer {
 public:
  PlantServer(std::unique_ptr<PlantBench> bench, std::unique_ptr<SharedSegment> shared,
              const ServeSettings& settings, const std::function<void(std::string_view)>& tell)
      : bench_(std::move(bench)), shared_(std::move(shared)), settings_(settings), tell_(tell) {}

  Expected<ServeResult> run(const std::atomic<bool>& stop);

 private:
  Expected<void> watch_shim();
  Expected<void> lose_shim();
  void tell_period();
  Expected<void> answer();

  std::unique_ptr<PlantBench> bench_;
  std::unique_ptr<SharedSegment> shared_;
  const ServeSettings& settings_;
  const std::function<void(std::string_view)>& tell_;
  std::int64_t next_look_ = 0;  // whether the component lives [ns]
  bool has_shim_ = false;
  int shim_ = 0;              // process of the component
  double told_period_ = 0.0;  // of a thread that does not fit [s]
};

Expected<void> PlantServer::lose_shim() {
  has_shim_ = false;
  bench_->switch_off();
  bench_->show(shared_->memory());
  tell_(fmt::format("plant {:.3f} s: LinuxCNC is gone, process {}: 0 V, servo off", bench_->time(),
                    shim_));
  return settings_.left ? settings_.left() : Expected<void>();
}

Expected<void> PlantServer::watch_shim() {
  const std::int64_t now = monotonic_ns();
  if (now < next_look_) {
    return {};
  }
  next_look_ = now + kShimCheck;
  const bool is_there = shared_->has_shim();
  const int process = shared_->memory().shim;
  if (has_shim_ && (!is_there || process != shim_)) {
    TWIN_CHECK(lose_shim());
  }
  if (is_there && !has_shim_) {
    has_shim_ = true;
    shim_ = process;
    tell_(fmt::format("plant {:.3f} s: LinuxCNC has come, process {}", bench_->time(), process));
  }
  tell_period();
  return {};
}

/// Says that the thread's period is another one than the plant's.
void PlantServer::tell_period() {
  const double seen = shared_->memory().seen_period;
  if (has_shim_ && seen != told_period_ &&
      std::abs(seen - settings_.setup.period) > 0.005 * settings_.setup.period) {
    tell_(
        fmt::format("plant {:.3f} s: LinuxCNC's thread has a period of {:.3f} ms, this plant one "
                    "of {:.3f} ms: nothing moves until they are the same",
                    bench_->time(), seen * 1e3, settings_.setup.period * 1e3));
  }
  told_period_ = seen;
}

Expected<void> PlantServer::answer() {
  twin_segment& memory = shared_->memory();
  if (settings_.record) {
    TWIN_CHECK(settings_.record(memory));
  }
  if (!bench_->advance(memory)) {
    return fail(ErrorCode::kMachine, bench_->last_error());
  }
  bench_->show(memory);
  ++memory.periods_answered;
  shared_->answer();
  for (const rig::emulator::Fault& fault : bench_->take_struck()) {
    tell_(fmt::format("plant {:.3f} s: fault {}", bench_->time(), to_string(fault)));
  }
  return {};
}

Expected<ServeResult> PlantServer::run(const std::atomic<bool>& stop) {
  twin_segment& memory = shared_->memory();
  bench_->describe(memory);
  bench_->show(memory);
  shared_->drop_question();
  memory.periods_asked = 0;
  memory.periods_answered = 0;
  memory.seen_period = 0.0;
  shared_->publish();
  if (settings_.started) {
    settings_.started(shared_->name());
  }
  while (!stop.load() && !(settings_.duration && bench_->time() >= *settings_.duration)) {
    TWIN_CHECK(watch_shim());
    if (shared_->wait_for_question(kPatience)) {
      TWIN_CHECK(answer());
    }
  }
  if (has_shim_ && settings_.left) {
    TWIN_CHECK(settings_.left());
  }
  return ServeResult{bench_->time(), memory.periods_asked, memory.periods_answered};
}

}  // namespace

Expected<ServeResult> serve_plant(ServeSettings settings, const std::atomic<bool>& stop,
                                  const std::function<void(std::string_view)>& tell) {
  TWIN_TRY(std::unique_ptr<PlantBench> bench, PlantBench::open(settings.setup));
  TWIN_TRY(std::unique_ptr<SharedSegment> shared,
           SharedSegment::make_plant(settings.name.empty() ? default_segment_name(Role::kPlant)
                                                           : settings.name));
  return PlantServer(std::move(bench), std::move(shared), settings, tell).run(stop);
}

}  // namespace twin::hal::linuxcnc
