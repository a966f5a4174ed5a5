#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/fuzz/chain/chain_case.hpp"

namespace twin::fuzz {
namespace {

constexpr double kBlockPeriods = 200.0;    // longest time of one block [periods]
constexpr double kProgramPeriods = 500.0;  // no further block after so long [periods]
constexpr std::size_t kMostBlocks = 60;
constexpr double kHalfRoom = 120.0;  // from here on it turns back, for the travel is 200 [mm]
constexpr double kHalfRoomZ = 40.0;

/// Writes a program from where it is, in the direction it goes.
class Writer {
 public:
  Writer(ByteSource& bytes, const config::MachineFile& machine)
      : bytes_(bytes), machine_(machine), builder_(machine.limits.rapid_feedrate) {
    builder_.set_feedrate(machine.limits.feedrate * bytes.uniform(0.02, 1.0));
  }

  MadeProgram write() {
    do {
      builder_.begin_stretch(bytes_.used());
      add_stretch();
    } while (!bytes_.is_empty() && has_room());
    if (time_ == 0.0) {
      line(1.0, false);  // a program without a move is none
    }
    return builder_.take();
  }

 private:
  bool has_room() const {
    return time_ < kProgramPeriods * machine_.period && builder_.size() < kMostBlocks;
  }

  void add_stretch() {
    switch (bytes_.choice(13)) {
      case 0:
      case 1:
        turn();
        return line(length(), false);
      case 2:
        turn();
        return line(length(), true);
      case 3:
      case 4:
        return arc();
      case 5:
        return run();
      case 6:
        return crumbs();
      case 7:
        return zigzag();
      case 8:
        return builder_.rest(bytes_.happens(64) ? 0.0
                                                : bytes_.uniform(0.0, 50.0) * machine_.period);
      case 9:
        return builder_.set_feedrate(machine_.limits.feedrate * bytes_.log_uniform(0.01, 1.0));
      case 10:
        return change_mode();
      case 11:
        return nurbs();
      default:
        return change_words();
    }
  }

  void change_mode() {
    switch (bytes_.choice(3)) {
      case 0:
        return builder_.set_exact_stop();
      case 1:
        return builder_.set_continuous(0.0);
      default:
        return builder_.set_continuous(bytes_.log_uniform(1e-3, 0.5));
    }
  }

  void change_words() {
    const unsigned which = bytes_.byte();
    switch (which % 4) {
      case 0:
        return builder_.set_inches((which & 4U) != 0);
      case 1:
        return builder_.set_incremental((which & 4U) != 0);
      case 2:
        return builder_.set_plane(static_cast<ProgramBuilder::Plane>((which >> 2U) % 3));
      default:
        return builder_.add_chaff(which >> 2U);
    }
  }

  double length() { return bytes_.log_uniform(1e-3, 60.0); }

  /// Turns by any angle, a small one, none, or right back.
  void turn() {
    switch (bytes_.choice(6)) {
      case 0:
        break;
      case 1:
        heading_ += bytes_.uniform(-0.1, 0.1);
        break;
      case 2:
        heading_ += std::numbers::pi;
        break;
      case 3:
        heading_ += bytes_.one_of({0.5, -0.5, 1e-4, -1e-5}) * std::numbers::pi;
        break;
      default:
        heading_ += bytes_.uniform(-std::numbers::pi, std::numbers::pi);
    }
  }

  Vec3 direction() const { return {std::cos(heading_), std::sin(heading_), 0.0}; }

  /// Turns towards the middle where a move of a length would lead out of the room.
  void keep_inside(double length) {
    const Vec3 at = builder_.position();
    const Vec3 to = at + length * direction();
    if (std::max(std::abs(to.x()), std::abs(to.y())) > kHalfRoom) {
      heading_ = std::atan2(-at.y(), -at.x());
    }
  }

  /// The largest share of a length, a power of a half, that takes no longer than a block may.
  double fit(double length, double feedrate) const {
    const Limits& l = machine_.limits;
    const double most = kBlockPeriods * machine_.period;
    const Pace pace =
        safe_pace(l, Vec3::Ones(), HUGE_VAL, feedrate, machine_.period, 1.0, machine_.planning);
    for (int i = 0; i < 60 && stop_time(length, pace) > most; ++i) {
      length *= 0.5;
    }
    return length;
  }

  /// Counts what was written since there were so many blocks.
  void count_from(std::size_t first) {
    for (std::size_t i = first; i < builder_.size(); ++i) {
      time_ += reference_time(builder_.pieces()[i], machine_);
    }
  }

  void line(double wanted, bool is_rapid) {
    const std::size_t first = builder_.size();
    const double length =
        fit(wanted, is_rapid ? machine_.limits.rapid_feedrate : builder_.feedrate());
    keep_inside(length);
    Vec3 way = length * direction();
    if (climb_ != 0.0) {
      way.z() =
          std::abs(builder_.position().z() + climb_ * length) < kHalfRoomZ ? climb_ * length : 0.0;
    }
    builder_.line_to(builder_.position() + way, is_rapid);
    count_from(first);
  }

  void arc() {
    const std::size_t first = builder_.size();
    const unsigned form = bytes_.byte();
    double sweep = (form & 1U) != 0 ? bytes_.uniform(0.02, 6.2) : bytes_.uniform(0.1, 1.6);
    sweep = (form & 0x1eU) == 0x1eU ? 7.0 : sweep;
    const double radius = fit(bytes_.log_uniform(0.01, 30.0) * sweep, builder_.feedrate()) / sweep;
    const double sense = (form & 32U) != 0 ? 1.0 : -1.0;
    if ((form & 64U) != 0) {
      turn();
    }
    keep_inside(2.0 * radius);
    const double rise = (form & 128U) != 0 ? bytes_.uniform(-1.0, 1.0) * radius : 0.0;
    const Vec2 centre = sense * radius * Vec2(-std::sin(heading_), std::cos(heading_));
    const bool leaves =
        std::abs(builder_.position().z()) + 2.0 * radius + std::abs(rise) > kHalfRoomZ;
    if (builder_.plane() != ProgramBuilder::Plane::kXy && leaves) {
      builder_.set_plane(ProgramBuilder::Plane::kXy);
    }
    builder_.arc(centre, sense * sweep, leaves ? 0.0 : rise, bytes_.happens(128));
    heading_ += sense * sweep;
    count_from(first);
  }

  /// Short lines along a curve.
  void run() {
    const std::size_t count = 3 + bytes_.choice(24);
    const double chord = bytes_.log_uniform(0.01, 2.0);
    const double bend = bytes_.uniform(-0.2, 0.2);
    const double noise = bytes_.one_of({0.0, 0.0, 1e-3, 0.05});
    climb_ = bytes_.happens(32) ? bytes_.uniform(-0.5, 0.5) : 0.0;
    for (std::size_t i = 0; i < count && has_room(); ++i) {
      heading_ += bend + (noise > 0.0 ? bytes_.uniform(-noise, noise) : 0.0);
      line(chord, false);
    }
    climb_ = 0.0;
  }

  /// Tiny moves.
  void crumbs() {
    const std::size_t count = 1 + bytes_.choice(16);
    const double longest = bytes_.log_uniform(1e-4, 0.3);
    for (std::size_t i = 0; i < count && has_room(); ++i) {
      const unsigned both = bytes_.byte();
      heading_ += 0.4 * ((both & 15U) - 8.0) * ((both & 15U) - 8.0) / 8.0;
      line(longest * std::pow(0.5, both >> 4U), false);
    }
  }

  /// The same way there and back, or at an angle.
  void zigzag() {
    const std::size_t count = 2 + bytes_.choice(12);
    const double length = bytes_.log_uniform(1e-4, 2.0);
    const double angle = bytes_.happens(128) ? std::numbers::pi : bytes_.uniform(0.02, 3.1);
    for (std::size_t i = 0; i < count && has_room(); ++i) {
      heading_ += i % 2 == 0 ? angle : -angle;
      line(length, false);
    }
  }

  void nurbs() {
    if (builder_.is_exact()) {
      builder_.set_continuous(0.0);
    }
    builder_.set_incremental(false);
    builder_.set_plane(ProgramBuilder::Plane::kXy);
    const std::size_t first = builder_.size();
    const unsigned form = bytes_.byte();
    const std::size_t degree = 2 + form % 3;
    const std::size_t count = degree + bytes_.choice(5);
    const double step = fit(bytes_.log_uniform(0.05, 20.0), builder_.feedrate());
    keep_inside(step * static_cast<double>(count));
    std::vector<Vec3> points;
    std::vector<double> weights(count + 1, 1.0);
    Vec3 at = builder_.position();
    for (std::size_t i = 0; i < count; ++i) {
      heading_ += i == 0 ? 0.0 : bytes_.uniform(-1.2, 1.2);
      at += step * direction();
      points.push_back(at);
      weights[i + 1] = (form & 16U) != 0 ? bytes_.log_uniform(0.2, 5.0) : 1.0;
    }
    if ((form & 8U) != 0) {
      builder_.uniform_nurbs(degree, std::move(points), std::move(weights));
    } else {
      std::vector<double> inner;
      for (std::size_t i = degree; i < count; ++i) {
        inner.push_back(bytes_.uniform(0.02, 0.95));
      }
      std::sort(inner.begin(), inner.end());
      for (std::size_t i = 1; i < inner.size(); ++i) {
        inner[i] = std::max(inner[i], inner[i - 1] + 0.003);  // no knot twice
      }
      builder_.knot_nurbs(degree, std::move(points), std::move(weights), inner);
    }
    count_from(first);
  }

  ByteSource& bytes_;
  const config::MachineFile& machine_;
  ProgramBuilder builder_;
  double heading_ = 0.0;  // [rad]
  double climb_ = 0.0;    // rise per length
  double time_ = 0.0;     // of what is written, with a stop after each block [s]
};

}  // namespace

double reference_time(const Piece& piece, const config::MachineFile& machine) {
  const std::vector<Vec3>& points = piece.shape.points;
  if (points.size() == 1) {
    return piece.dwell;
  }
  const Pace pace =
      safe_pace(machine.limits, directions_of(points), piece.shape.radius, piece.feedrate,
                machine.period, machine.path.chord_error, machine.planning);
  const double time = stop_time(length_of(points), pace);
  switch (machine.planning.acceleration_profile) {
    case AccelerationProfile::kTrapezoidal:
      return time;
    case AccelerationProfile::kSCurve:  // the mean acceleration of a ramp is at least A / 2
      return 2.0 * time;
    default:  // a moving average over A / J
      return time + 2.0 * machine.limits.acceleration / machine.limits.jerk;
  }
}

MadeProgram make_program(ByteSource& bytes, const config::MachineFile& machine) {
  return Writer(bytes, machine).write();
}

}  // namespace twin::fuzz
