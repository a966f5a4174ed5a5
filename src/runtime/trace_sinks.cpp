#include "runtime/trace_sinks.hpp"

#include <utility>

#include "runtime/run_errors.hpp"

namespace twin::runtime {
namespace {

/// Calls a function of a sink.
template <class Call>
Expected<void> call_sink(const Call& call) {
  try {
    if (std::optional<Error> error = call()) {
      return tl::unexpected(std::move(*error));
    }
  } catch (...) {
    return tl::unexpected(thrown("a trace sink"));
  }
  return {};
}

}  // namespace

Expected<void> TraceSinks::begin(const std::vector<TraceSink*>& sinks, const TraceHeader& header) {
  for (TraceSink* const sink : sinks) {
    if (auto begun = call_sink([&] { return sink->begin(header); }); !begun) {
      abandon();
      return begun;
    }
    open_.push_back(sink);
  }
  return {};
}

Expected<void> TraceSinks::rows(std::span<const double> values) {
  Expected<void> first;
  for (TraceSink* const sink : open_) {
    auto taken = call_sink([&] { return sink->rows(values); });
    if (first) {
      first = std::move(taken);
    }
  }
  return first;
}

Expected<void> TraceSinks::commit() {
  while (!open_.empty()) {
    TWIN_CHECK(call_sink([&] { return open_.back()->commit(); }));
    open_.pop_back();
  }
  return {};
}

void TraceSinks::abandon() noexcept {
  for (TraceSink* const sink : open_) {
    sink->abandon();
  }
  open_.clear();
}

}  // namespace twin::runtime
