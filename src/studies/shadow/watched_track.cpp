#include "studies/shadow/watched_track.hpp"

#include "core/stop_wish.hpp"

namespace twin::studies::shadow {

Expected<twin::shadow::ShadowReport> watch_track(const config::MachineFile& machine,
                                                 const twin::shadow::Track& track,
                                                 const std::filesystem::path& learnt, bool gives,
                                                 const std::atomic<bool>* stop) {
  TWIN_TRY(const twin::shadow::Baseline baseline,
           twin::shadow::baseline_of(machine, learnt, gives, track.recorded));
  TWIN_CHECK(twin::shadow::check_signals(baseline, track, machine));
  twin::shadow::Shadow watcher(machine, baseline, gives, machine.shadow.hours, track.recorded);
  for (const twin::shadow::ShadowSample& sample : track.samples) {
    TWIN_CHECK(check_wish(stop, "interrupted: the recording was not watched to its end"));
    watcher.step(sample);
  }
  twin::shadow::ShadowReport report = twin::shadow::make_report(watcher, baseline, machine);
  report.periods = static_cast<std::int64_t>(track.samples.size());
  if (watcher.has_failed()) {
    report.switched_off = "its model is not finite any more";
  }
  return report;
}

}  // namespace twin::studies::shadow
