#include "studies/convert/converter.hpp"

#include <fmt/format.h>

#include <deque>
#include <optional>
#include <utility>

#include "path/path_builder.hpp"
#include "studies/convert/program_writer.hpp"

namespace twin::studies::convert {
namespace {

/// Takes blocks and the segments made of them, and writes.
class Converter {
 public:
  Converter(const Vec3& start, const Dialect& dialect, const PathSettings& settings)
      : settings_(settings), writer_(dialect, start) {}

  ProgramWriter& writer() { return writer_; }
  const std::optional<Error>& error() const { return error_; }

  void expect(const gcode::Block& block) {
    pending_.push_back(block);
    ++conversion_.blocks;
  }

  void take(const path::Segment& segment) {
    if (error_) {
      return;
    }
    const std::int64_t first = segment.marks.front().block;
    for (; first_ < first; ++first_) {
      pending_.pop_front();
    }
    const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry);
    if (curve == nullptr) {
      add_group(1, writer_.write(pending_.front()));
    } else {
      take_curve(*curve, segment);
    }
  }

  Conversion finish() {
    conversion_.text = writer_.text();
    conversion_.lines = writer_.lines();
    return std::move(conversion_);
  }

 private:
  void take_curve(const path::FittedCurve& fitted, const path::Segment& segment) {
    const gcode::Block& block = pending_.front();
    std::vector<Vec3> polygon;
    if (!fitted.is_programmed) {
      polygon.push_back(block.start);
      for (std::size_t i = 0; i < segment.marks.size(); ++i) {
        polygon.push_back(pending_[i].end);
      }
      conversion_.fitted_blocks += static_cast<std::int64_t>(segment.marks.size());
    }
    auto counts =
        writer_.write_curve({fitted.curve, polygon, tolerance_of(block), block.line}, block);
    if (!counts) {
      error_ = counts.error();
      return;
    }
    if (fitted.is_programmed && last_block_ == first_) {
      conversion_.groups.back().made += counts->blocks;  // another part of the same NURBS
    } else {
      ++conversion_.curves;
      add_group(static_cast<std::int64_t>(segment.marks.size()), counts->blocks);
    }
    conversion_.nurbs.blocks += counts->blocks;
    conversion_.nurbs.control_points += counts->control_points;
    conversion_.nurbs.refitted += counts->refitted;
  }

  void add_group(std::int64_t blocks, std::int64_t made) {
    const gcode::Block& block = pending_.front();
    conversion_.groups.push_back({blocks, made, tolerance_of(block), block.line});
    last_block_ = first_;
  }

  double tolerance_of(const gcode::Block& block) const {
    return block.tolerance > 0.0 ? block.tolerance : settings_.chord_error;
  }

  PathSettings settings_;
  ProgramWriter writer_;
  std::deque<gcode::Block> pending_;  // from block first_ on
  std::int64_t first_ = 0;
  std::int64_t last_block_ = -1;  // first one of the last group
  Conversion conversion_;
  std::optional<Error> error_;
};

}  // namespace

Expected<Conversion> convert_program(gcode::Reader& reader, const Vec3& start,
                                     const std::string& name, const Dialect& dialect,
                                     const PathSettings& settings, const PlanningModel& planning,
                                     const Limits& limits) {
  Converter converter(start, dialect, settings);
  converter.writer().comment(fmt::format("{} for {}", name, dialect.control()));
  converter.writer().comment("made by twin convert; spindle, coolant and tool words left out");
  converter.writer().begin();
  path::PathBuilder builder(settings, planning, limits,
                            [&](path::Segment&& segment) { converter.take(segment); });
  for (;;) {
    TWIN_TRY(auto block, reader.next());
    if (!block.has_value()) {
      break;
    }
    converter.expect(*block);
    builder.push(*block);
    if (converter.error()) {
      break;
    }
  }
  builder.finish();
  if (converter.error()) {
    return tl::unexpected(*converter.error());
  }
  converter.writer().end();
  Conversion conversion = converter.finish();
  conversion.lines_before = reader.line();
  return conversion;
}

}  // namespace twin::studies::convert
