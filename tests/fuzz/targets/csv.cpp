#include <cmath>
#include <vector>

#include "results/trace/csv_reader.hpp"
#include "studies/identify/recording.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace csv_target {

void read_as_table(const MemoryFile& file) {
  auto reader = results::CsvReader::open(file.path());
  if (!reader) {
    promise(!reader.error().message.empty(), "an error without a message");
    return;
  }
  std::vector<double> row(reader->header().size());
  for (auto has_row = reader->next(row); has_row && *has_row; has_row = reader->next(row)) {
    for (const double value : row) {
      promise(std::isfinite(value), "a value that is not finite");
    }
  }
}

void read_as_recording(const MemoryFile& file) {
  using namespace studies::identify;
  const auto recording = read_recording(file.path(), trace_columns(), Limits{});
  if (!recording) {
    promise(!recording.error().message.empty(), "an error without a message");
    return;
  }
  promise(recording->period > 0.0, "a recording without a period");
  for (const AxisSignals& axis : recording->axis) {
    promise(!axis.is_recorded() ||
                (axis.command.size() == recording->rows && axis.measured.size() == recording->rows),
            "columns of a recording that are not of one length");
  }
}

void run(Bytes bytes) {
  const MemoryFile file(bytes);
  read_as_table(file);
  read_as_recording(file);
}

}  // namespace csv_target

const Target kCsv{"csv", csv_target::run};

}  // namespace twin::fuzz
