#include "results/trace/columns.hpp"

#include <initializer_list>
#include <string>

#include "core/units.hpp"

namespace twin::results {

TraceHeader trace_header(Layout layout, double period) {
  TraceHeader header{.columns = {}, .period = period};
  const std::size_t count = layout == Layout::kPlan ? kPlanColumns : kColumns.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_whole = kColumns[i] == "segment" || kColumns[i] == "line";
    header.columns.push_back(
        {.name = std::string(kColumns[i]),
         .kind = is_whole ? TraceColumn::Kind::kWhole : TraceColumn::Kind::kReal});
  }
  return header;
}

void append_row(const Sample& sample, double contour_error, Layout layout,
                std::vector<double>& rows) {
  const auto append = [&rows](std::initializer_list<double> values) {
    rows.insert(rows.end(), values);
  };
  append({sample.t, static_cast<double>(sample.segment), static_cast<double>(sample.line),
          sample.command.x(), sample.command.y(), sample.command.z(), sample.feedrate});
  if (layout == Layout::kRun) {
    const Vec2 tracking_error = sample.command.head<2>() - sample.encoder;  // [mm]
    append({sample.encoder.x(), sample.encoder.y(), sample.table.x(), sample.table.y(),
            sample.volts.x(), sample.volts.y(), units::um_from_mm(contour_error),
            units::um_from_mm(tracking_error.x()), units::um_from_mm(tracking_error.y())});
  }
}

}  // namespace twin::results
