#include "results/trace/csv_writer.hpp"

#include <utility>

#include "core/units.hpp"
#include "results/trace/columns.hpp"

namespace twin::results {

Expected<CsvWriter> CsvWriter::create(const std::filesystem::path& directory, Layout layout) {
  const std::size_t count = layout == Layout::kPlan ? kPlanColumns : kColumns.size();
  auto file = CsvFile::create(directory / kTraceName, directory / kPartialTraceName,
                              std::span(kColumns).first(count), OnAbandon::kKeep);
  if (!file) {
    return tl::unexpected(std::move(file.error()));
  }
  return CsvWriter(std::move(*file), layout);
}

Expected<void> CsvWriter::write(const Sample& sample, double contour_error) {
  row_.add(sample.t).add(sample.segment).add(sample.line);
  row_.add(sample.command.x()).add(sample.command.y()).add(sample.command.z());
  row_.add(sample.feedrate);
  if (layout_ == Layout::kRun) {
    const Vec2 tracking_error = sample.command.head<2>() - sample.encoder;  // [mm]
    row_.add(sample.encoder.x()).add(sample.encoder.y());
    row_.add(sample.table.x()).add(sample.table.y());
    row_.add(sample.volts.x()).add(sample.volts.y());
    row_.add(units::um_from_mm(contour_error));
    row_.add(units::um_from_mm(tracking_error.x())).add(units::um_from_mm(tracking_error.y()));
  }
  return file_.write(row_);
}

}  // namespace twin::results
