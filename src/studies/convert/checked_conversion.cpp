#include "studies/convert/checked_conversion.hpp"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>

#include "core/text_table.hpp"
#include "core/units.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {
namespace {

constexpr double kWrittenRounding = 2e-6;  // of the coordinates in the file [mm]

/// Form in which a dialect that this reader does not read is read back: the same curves with the
/// same digits.
constexpr std::string_view kReadable = "g6.2";

Expected<Conversion> convert_to(const Job& job, const Dialect& dialect) {
  gcode::Reader reader(job.program, job.reading);
  auto conversion =
      convert_program(reader, job.reading.start, job.program.file().filename().string(), dialect,
                      job.path, job.planning, job.limits);
  if (!conversion && conversion.error().file.empty()) {
    conversion.error().file = job.program.file().string();
  }
  return conversion;
}

/// Reads the new program back and holds it against the old one.
Expected<Deviation> check_conversion(const Job& job, const Conversion& conversion) {
  gcode::Reader before(job.program, job.reading);
  gcode::ReaderOptions reading;
  reading.start = job.reading.start;
  auto after = gcode::Reader::from_text(conversion.text, "the converted program", reading);
  TWIN_TRY(const Deviation deviation, compare_programs(before, after, conversion.groups));
  if (deviation.largest > deviation.tolerance + kWrittenRounding) {
    return tl::unexpected(Error{
        ErrorCode::kProgram,
        fmt::format("the converted program would be {:.3f} um from this line, its tolerance "
                    "is {:g} um; nothing was written",
                    units::um_from_mm(deviation.largest), units::um_from_mm(deviation.tolerance)),
        job.program.file().string(), static_cast<int>(deviation.line), 0});
  }
  return deviation;
}

}  // namespace

Expected<CheckedConversion> convert_and_check(const Job& job, const std::string& dialect) {
  CheckedConversion checked;
  TWIN_TRY(checked.conversion, convert_to(job, *make_dialect(dialect)));
  if (is_readable(dialect)) {
    TWIN_TRY(checked.deviation, check_conversion(job, checked.conversion));
    return checked;
  }
  TWIN_TRY(const Conversion readable, convert_to(job, *make_dialect(kReadable)));
  TWIN_TRY(checked.deviation, check_conversion(job, readable));
  return checked;
}

std::string to_table(const Job& job, const std::string& dialect, const CheckedConversion& checked) {
  const Conversion& c = checked.conversion;
  std::int64_t made = 0;
  for (const Group& group : c.groups) {
    made += group.made;
  }
  const auto line = [](const char* name, std::string before, std::string after) {
    return Line{
        .row = name, .what = {}, .cells = {{std::move(before)}, {std::move(after)}}, .note = {}};
  };
  TextTable table;
  table.head = {"before", "after"};
  table.lines = {
      line("lines of text", fmt::to_string(c.lines_before), fmt::to_string(c.lines)),
      line("blocks", fmt::to_string(c.blocks), fmt::to_string(made)),
      line("of them in curves", fmt::to_string(c.fitted_blocks), fmt::to_string(c.nurbs.blocks)),
      line("control points", "", fmt::to_string(c.nurbs.control_points))};
  std::string text = fmt::format("{} for {}\n\n{}", job.program.file().filename().string(),
                                 make_dialect(dialect)->control(),
                                 to_text(table, {.indent = 2, .row_width = 27, .cell_width = 10}));
  if (dialect == "g5.2" && c.nurbs.blocks > 0) {
    text +=
        fmt::format("  curves: {} on new uniform knots, {} as {} exact pieces\n", c.nurbs.refitted,
                    c.curves - c.nurbs.refitted, c.nurbs.blocks - c.nurbs.refitted);
  }
  return text + fmt::format(
                    "\n  largest deviation from the programmed path, read back{}:\n"
                    "  {:.3f} um of {:g} um, line {}\n",
                    is_readable(dialect) ? "" : " as G6.2",
                    units::um_from_mm(checked.deviation.largest),
                    units::um_from_mm(checked.deviation.tolerance), checked.deviation.line);
}

}  // namespace twin::studies::convert
