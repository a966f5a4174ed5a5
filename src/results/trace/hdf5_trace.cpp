#include "results/trace/hdf5_trace.hpp"

#include <string_view>

#include "core/this_program.hpp"
#include "results/trace/trace_files.hpp"

namespace twin::results {

Expected<void> Hdf5Trace::open(const TraceHeader& header) {
  TWIN_TRY(const Hdf5Module* const module, hdf5_module());
  TWIN_TRY(file_,
           AtomicFile::create(directory_ / kHdf5TraceName, directory_ / kPartialHdf5TraceName,
                              OnAbandon::kKeep, durability_));
  TWIN_TRY(writer_, module->create(file_->temporary(), header.columns));
  TWIN_CHECK(writer_->set_text("version", version()));
  TWIN_CHECK(writer_->set_text("program", origin_.program));
  TWIN_CHECK(writer_->set_text("program_sha256", origin_.program_sha256));
  return writer_->set_text("settings", origin_.settings);
}

std::optional<Error> Hdf5Trace::begin(const TraceHeader& header) { return why_not(open(header)); }

std::optional<Error> Hdf5Trace::rows(std::span<const double> values) {
  return why_not(writer_->rows(values));
}

Expected<void> Hdf5Trace::finish() {
  if (!summary_.empty()) {
    TWIN_CHECK(writer_->set_text("summary", summary_));
  }
  return writer_->close();
}

std::optional<Error> Hdf5Trace::commit() {
  return why_not(finish().and_then([this] { return file_->commit(); }));
}

void Hdf5Trace::abandon() noexcept {
  if (writer_) {
    static_cast<void>(finish());
    writer_.reset();
  }
  if (file_) {
    file_->abandon();
  }
}

}  // namespace twin::results
