#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "gcode/block.hpp"

namespace twin::gcode {
namespace {

double without_minus_zero(double value) { return std::abs(value) < 5e-10 ? 0.0 : value; }

std::string to_text(const Vec3& point) {
  return fmt::format("({:.9f} {:.9f} {:.9f})", without_minus_zero(point.x()),
                     without_minus_zero(point.y()), without_minus_zero(point.z()));
}

std::string to_text(const geometry::Curve& curve) {
  std::string text = fmt::format("degree {} U", curve.degree());
  for (const double knot : curve.knots()) {
    text += fmt::format(" {:.6g}", knot);
  }
  for (std::size_t i = 0; i < curve.control_points().size(); ++i) {
    text += fmt::format(" {}", to_text(curve.control_points()[i]));
    if (curve.is_rational()) {
      text += fmt::format("w{:.6g}", curve.weights()[i]);
    }
  }
  return text;
}

}  // namespace

Expected<std::vector<Block>> read_rest(Reader& reader) {
  std::vector<Block> blocks;
  while (true) {
    auto block = reader.next();
    if (!block) {
      return tl::unexpected<Error>(block.error());
    }
    if (!*block) {
      return blocks;
    }
    blocks.push_back(**block);
  }
}

Expected<std::vector<Block>> read_program(const std::string& text, const ReaderOptions& options) {
  Reader reader = Reader::from_text(text, "", options);
  return read_rest(reader);
}

std::vector<Block> blocks_of(const std::string& text, const ReaderOptions& options) {
  auto blocks = read_program(text, options);
  if (!blocks) {
    ADD_FAILURE() << to_string(blocks.error()) << "\n" << text;
    return {};
  }
  return *blocks;
}

std::string error_of(const std::string& text, const ReaderOptions& options) {
  const auto blocks = read_program(text, options);
  if (blocks) {
    ADD_FAILURE() << "read without an error:\n" << text;
    return "";
  }
  return to_string(blocks.error());
}

std::string to_text(const Block& block) {
  if (block.motion == Motion::kDwell) {
    return fmt::format("{} dwell {} {:.9f} s", block.line, to_text(block.start), block.dwell);
  }
  const char* const names[] = {"rapid", "linear", "arc", "nurbs"};
  std::string text =
      fmt::format("{} {} {} {} -> {}", block.line, names[static_cast<int>(block.motion)],
                  block.path_mode == PathMode::kContinuous ? "continuous" : "exact",
                  to_text(block.start), to_text(block.end));
  if (block.motion == Motion::kArc) {
    text +=
        fmt::format(" c {} n {} r {:.9f} a {:.9f}", to_text(block.arc.centre),
                    to_text(block.arc.e1.cross(block.arc.e2)), block.arc.radius, block.arc.sweep);
  }
  if (block.motion == Motion::kNurbs) {
    text += " " + to_text(block.nurbs->curve);
  }
  return text + fmt::format(" F {:.9f} P {:.9f}", block.feedrate, block.tolerance);
}

std::string to_text(const std::vector<Block>& blocks) {
  std::string text;
  for (const Block& block : blocks) {
    text += to_text(block) + "\n";
  }
  return text;
}

}  // namespace twin::gcode
