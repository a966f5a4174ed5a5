#include "studies/predict/feed_program.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace twin::studies::predict {
namespace {

/// Writes blocks, each on a line of its own.
class FeedWriter {
 public:
  explicit FeedWriter(const Vec3& workpiece) : workpiece_(workpiece) {}

  Expected<void> add(const gcode::Block& block, double feedrate) {
    write_mode(block);
    if (block.motion == gcode::Motion::kDwell) {
      text_ += fmt::format("G04 P{:.6g}\n", block.dwell);
      return {};
    }
    const Vec3 end = block.end - workpiece_;
    const std::string place = fmt::format("X{:.6f} Y{:.6f} Z{:.6f}", end.x(), end.y(), end.z());
    const double f = units::mm_per_min_from_mm_per_s(feedrate);
    switch (block.motion) {
      case gcode::Motion::kRapid:
        text_ += fmt::format("G00 {}\n", place);
        return {};
      case gcode::Motion::kLinear:
        text_ += fmt::format("G01 {} F{:.3f}\n", place, f);
        return {};
      case gcode::Motion::kArc:
        return add_arc(block, place, f);
      default:
        return refuse(block, "a NURBS");
    }
  }

  std::string take() { return std::move(text_); }

 private:
  static tl::unexpected<Error> refuse(const gcode::Block& block, const std::string& what) {
    Error error{ErrorCode::kProgram,
                what +
                    " gets no feedrate of its own: the largest feedrate of the whole program is "
                    "all that can be said",
                {},
                static_cast<int>(block.line),
                0};
    return tl::unexpected(std::move(error));
  }

  Expected<void> add_arc(const gcode::Block& block, const std::string& place, double f) {
    const Vec3 axis = block.arc.e1.cross(block.arc.e2);
    if (std::abs(std::abs(axis.z()) - 1.0) > 1e-9 ||
        block.arc.sweep > 2.0 * std::numbers::pi + 1e-9) {
      return refuse(block, "an arc about another axis than Z, or of several turns,");
    }
    const Vec3 centre = block.arc.centre - block.start;
    text_ += fmt::format("{} {} I{:.6f} J{:.6f} F{:.3f}\n", axis.z() > 0.0 ? "G03" : "G02", place,
                         centre.x(), centre.y(), f);
    return {};
  }

  void write_mode(const gcode::Block& block) {
    const bool stops = block.path_mode == gcode::PathMode::kExactStop;
    if (has_mode_ && stops == stops_ && block.tolerance == tolerance_) {
      return;
    }
    text_ += stops                   ? "G61\n"
             : block.tolerance > 0.0 ? fmt::format("G64 P{:.6f}\n", block.tolerance)
                                     : "G64\n";
    has_mode_ = true;
    stops_ = stops;
    tolerance_ = block.tolerance;
  }

  Vec3 workpiece_;
  std::string text_;
  bool has_mode_ = false;
  bool stops_ = false;
  double tolerance_ = 0.0;
};

}  // namespace

Expected<std::string> feed_program(std::span<const gcode::Block> blocks,
                                   std::span<const double> feedrates,
                                   const config::MachineFile& machine, const std::string& title) {
  FeedWriter writer(machine.program.workpiece);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    TWIN_CHECK(writer.add(blocks[i], feedrates[i]));
  }
  return fmt::format("({})\nG90 G21 G17\n{}M02\n", title, writer.take());
}

}  // namespace twin::studies::predict
