#pragma once

#include <span>
#include <vector>

#include "core/error.hpp"
#include "twin/trace.hpp"

namespace twin::runtime {

/// All sinks of a run as one. What a sink throws becomes an error.
class TraceSinks {
 public:
  TraceSinks() = default;
  TraceSinks(TraceSinks&&) noexcept = default;
  TraceSinks& operator=(TraceSinks&&) = delete;
  TraceSinks(const TraceSinks&) = delete;
  TraceSinks& operator=(const TraceSinks&) = delete;
  /// Abandons the sinks that were not committed.
  ~TraceSinks() { abandon(); }

  /// Begins a trace in every sink. Where one fails, the trace is abandoned.
  Expected<void> begin(const std::vector<TraceSink*>& sinks, const TraceHeader& header);
  /// Hands rows to every sink, also to those after one that fails. @param values (rows x columns)
  /// @returns the first error
  Expected<void> rows(std::span<const double> values);
  /// Commits one sink after the other, the last one first, up to one that fails.
  Expected<void> commit();
  /// Abandons every sink that was begun and not committed.
  void abandon() noexcept;

 private:
  std::vector<TraceSink*> open_;  // begun, and neither committed nor abandoned
};

}  // namespace twin::runtime
