#include "studies/convert/program_writer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {
namespace {

constexpr int kFeedDecimals = 6;  // of mm/min

/// The plane of an arc, by the axis it turns about, and the letters of its centre.
struct PlaneWords {
  const char* plane;
  char letters[2];
  Eigen::Index axes[2];
  Eigen::Index normal;
};

constexpr PlaneWords kPlanes[] = {
    {"G17", {'I', 'J'}, {0, 1}, 2}, {"G18", {'I', 'K'}, {0, 2}, 1}, {"G19", {'J', 'K'}, {1, 2}, 0}};

const PlaneWords& plane_of(const Vec3& axis) {
  const double along_z = std::abs(axis.z());
  if (along_z >= std::abs(axis.x()) && along_z >= std::abs(axis.y())) {
    return kPlanes[0];
  }
  return std::abs(axis.y()) >= std::abs(axis.x()) ? kPlanes[1] : kPlanes[2];
}

}  // namespace

ProgramWriter::ProgramWriter(const Dialect& dialect, const Vec3& start)
    : dialect_(dialect), position_(start) {}

void ProgramWriter::comment(std::string_view text) { text_ += dialect_.comment(text) + "\n"; }

void ProgramWriter::begin() { text_ += dialect_.preamble() + "\n"; }

std::int64_t ProgramWriter::lines() const noexcept {
  return std::count(text_.begin(), text_.end(), '\n');
}

Vec3 ProgramWriter::in_file(const Vec3& place) const {
  return place.unaryExpr([&](double x) { return rounded(x, dialect_.decimals()); });
}

std::int64_t ProgramWriter::write(const gcode::Block& block) {
  set_mode(block);
  if (block.motion == gcode::Motion::kDwell) {
    text_ += dialect_.dwell(block.dwell) + "\n";
    return 1;
  }
  if (block.motion == gcode::Motion::kArc) {
    return write_arc(block);
  }
  if (in_file(block.end) == position_) {
    return 0;
  }
  write_move(block.motion == gcode::Motion::kRapid ? "G00" : "G01", axis_words(block.end), block);
  return 1;
}

std::int64_t ProgramWriter::write_arc(const gcode::Block& block) {
  const geometry::Arc& arc = block.arc;
  const Vec3 axis = arc.e1.cross(arc.e2);
  const PlaneWords& plane = plane_of(axis);
  const Vec3 end = in_file(block.end);
  if (end == position_ && arc.sweep < std::numbers::pi) {
    return 0;
  }
  if (plane_ != plane.plane) {
    plane_ = plane.plane;
    text_ += plane_ + "\n";
  }
  std::string words = axis_words(block.end);
  for (std::size_t i = 0; i < 2; ++i) {
    const double offset = arc.centre[plane.axes[i]] - block.start[plane.axes[i]];
    words += fmt::format(" {}{}", plane.letters[i], number(offset, dialect_.decimals()));
  }
  const double turns = std::ceil(arc.sweep / (2.0 * std::numbers::pi) - 1e-9);
  if (turns > 1.0) {
    words += fmt::format(" P{:.0f}", turns);
  }
  write_move(axis[plane.normal] > 0.0 ? "G03" : "G02", words, block);
  return 1;
}

Expected<CurveCounts> ProgramWriter::write_curve(const CurveRequest& request,
                                                 const gcode::Block& demands) {
  set_mode(demands);
  if (plane_ != "G17") {
    plane_ = "G17";
    text_ += "G17\n";
  }
  if (const std::string feed = feed_word(demands); !feed.empty()) {
    text_ += feed.substr(1) + "\n";
  }
  auto counts = dialect_.write_curve(request, text_);
  position_ = in_file(request.curve.control_points().back());
  motion_.clear();  // the end of a curve leaves none in force
  return counts;
}

void ProgramWriter::set_mode(const gcode::Block& block) {
  std::string mode = dialect_.path_mode(block.path_mode, block.tolerance);
  if (mode != mode_) {
    mode_ = std::move(mode);
    text_ += mode_ + "\n";
  }
}

/// " F3000" where it changes.
std::string ProgramWriter::feed_word(const gcode::Block& block) {
  if (block.motion == gcode::Motion::kRapid) {
    return {};
  }
  std::string feed = " F" + number(units::mm_per_min_from_mm_per_s(block.feedrate), kFeedDecimals);
  if (feed == feed_) {
    return {};
  }
  feed_ = feed;
  return feed;
}

/// " X1 Y2": the axes that move, X and Y always.
std::string ProgramWriter::axis_words(const Vec3& end) {
  const Vec3 place = in_file(end);
  std::string words = fmt::format("X{} Y{}", number(place.x(), dialect_.decimals()),
                                  number(place.y(), dialect_.decimals()));
  if (place.z() != position_.z()) {
    words += " Z" + number(place.z(), dialect_.decimals());
  }
  position_ = place;
  return words;
}

void ProgramWriter::write_move(const std::string& word, const std::string& words,
                               const gcode::Block& block) {
  if (word != motion_) {
    text_ += word + " ";
    motion_ = word;
  }
  text_ += words + feed_word(block) + "\n";
}

}  // namespace twin::studies::convert
