#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "shadow/report.hpp"
#include "shadow/shadow.hpp"
#include "twin/trace.hpp"

namespace twin::shadow {

/// How a shadow watches a run.
struct LiveOptions {
  bool is_wall_clock = false;
  /// Gets a line on what was found, and on a shadow that is switched off. Called by the thread that
  /// records.
  std::function<void(const std::string&)> tell{};
};

/// The shadow beside a run: it gets the rows from the recorder and works in a thread of its own.
///
///   motion ==> sample queue ==> recorder ==> queue of rows ==> shadow
///
/// Neither motion nor recorder waits for it on the wall clock: where its queue is full, it is
/// switched off with a line and the run goes on. In simulated time the recorder waits, so that the
/// result does not depend on threads.
///
/// With the reaction "stop" a finding is an error of this sink: the machine brakes on the path and
/// the run ends.
class LiveShadow final : public TraceSink {
 public:
  static constexpr std::size_t kQueue = 8192;  ///< rows: 8 s at a period of 1 ms

  /// @param machine  outlives this
  LiveShadow(const config::MachineFile& machine, Baseline baseline, bool gives,
             LiveOptions options);
  ~LiveShadow() override;

  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override;

  /// What it saw; after commit() or abandon().
  const ShadowReport& report() const noexcept { return report_; }

 private:
  std::optional<Error> find_columns(const TraceHeader& header);
  ShadowSample sample_of(const double* row) const noexcept;
  void watch();
  void take(const ShadowSample& sample);
  void switch_off(std::string why);
  std::optional<Error> tell_news();
  void end() noexcept;

  const config::MachineFile& machine_;
  Baseline baseline_;
  bool gives_;
  LiveOptions options_;
  std::vector<std::size_t> columns_;  // of time, line, then measured, volts, scale of x and y
  std::size_t width_ = 0;
  std::unique_ptr<Shadow> shadow_;
  boost::lockfree::spsc_queue<ShadowSample> queue_{kQueue};
  std::atomic<std::uint32_t> pushed_{0};  // grows when the shadow is to look
  std::atomic<std::uint32_t> popped_{0};  // grows when the recorder is to look
  std::int64_t sent_ = 0;                 // rows, by the recorder
  std::atomic<std::int64_t> done_{0};     // rows, by the shadow
  std::atomic<bool> is_closed_{false};
  std::atomic<bool> is_off_{false};
  std::atomic<bool> has_news_{false};
  std::mutex mutex_;  // of the news
  std::vector<std::string> news_;
  std::string why_off_;  // of the recorder's thread
  double last_time_ = 0.0;
  double cpu_time_ = 0.0;  // of the shadow's thread [s]
  std::int64_t watched_ = 0;
  std::jthread thread_;
  ShadowReport report_;
};

/// The shadow of an identified machine, which goes by what was learnt of it.
/// @param machine  outlives the shadow
/// @param learnt   what healthy runs are like, a file; empty: only the model and its uncertainty
Expected<std::unique_ptr<LiveShadow>> make_live_shadow(const config::MachineFile& machine,
                                                       const std::filesystem::path& learnt,
                                                       LiveOptions options);

}  // namespace twin::shadow
