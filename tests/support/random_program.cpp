#include "random_program.hpp"

#include "tests/support/blocks.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::test {
namespace {

/// Writes a program block by block from where it is, in the direction it goes.
class Writer {
 public:
  explicit Writer(std::mt19937& random) : random_(random) {}

  std::vector<gcode::Block> take() { return std::move(blocks_); }

  void write_piece() {
    if (random_() % 3 == 0) {
      feedrate_ = log_uniform(random_, 0.5, 150.0);
    }
    mode_ = random_() % 15 == 0 ? gcode::PathMode::kExactStop : gcode::PathMode::kContinuous;
    switch (random_() % 10) {
      case 0:
        return add(dwell_block(at_, random_() % 3 == 0 ? 0.0 : part(0.0, 0.3)));
      case 1:
        turn(part(-3.1, 3.1));
        line(log_uniform(random_, 0.5, 30.0), true);
        return;
      case 2:
      case 3:
        return arc();
      case 4:
      case 5:
        return smooth_run(static_cast<int>(3 + random_() % 80));
      case 6:
        return crumbs(static_cast<int>(1 + random_() % 30));
      case 7:
        return zigzag(static_cast<int>(2 + random_() % 20));
      default:
        turn(random_() % 3 == 0 ? 0.0 : part(-3.1, 3.1) * part(0.0, 1.0));
        line(log_uniform(random_, 0.01, 30.0));
    }
  }

 private:
  double part(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 direction() const { return {std::cos(heading_), std::sin(heading_), 0.0}; }
  void turn(double angle) { heading_ += angle; }

  void add(gcode::Block block) {
    block.path_mode = mode_;
    block.line = static_cast<std::int64_t>(blocks_.size()) + 1;
    at_ = block.end;
    blocks_.push_back(block);
  }
  void line(double length, bool is_rapid = false) {
    gcode::Block block = line_block(at_, at_ + length * direction(), feedrate_);
    block.motion = is_rapid ? gcode::Motion::kRapid : gcode::Motion::kLinear;
    add(block);
  }
  void arc() {
    turn(random_() % 2 == 0 ? 0.0 : part(-1.0, 1.0));
    const bool is_left = random_() % 2 == 0;
    const double sweep = part(0.05, 6.0);
    const double rise = random_() % 4 == 0 ? part(-1.0, 1.0) : 0.0;
    add(arc_block(at_, direction(), log_uniform(random_, 0.05, 10.0), sweep, is_left, feedrate_,
                  rise));
    turn(is_left ? sweep : -sweep);
  }
  void smooth_run(int count) {
    const double chord = log_uniform(random_, 0.03, 0.6);
    double bend = 0.0;
    for (int i = 0; i < count; ++i) {
      bend = std::clamp(bend + part(-0.02, 0.02), -0.12, 0.12);
      turn(bend);
      line(chord);
    }
  }
  void crumbs(int count) {
    for (int i = 0; i < count; ++i) {
      turn(part(-1.5, 1.5) * part(0.0, 1.0));
      line(log_uniform(random_, 1e-4, 0.3));
    }
  }
  void zigzag(int count) {
    const double length = log_uniform(random_, 0.005, 1.0);
    const double angle = part(0.05, 3.1);
    for (int i = 0; i < count; ++i) {
      turn(i % 2 == 0 ? angle : -angle);
      line(length);
    }
  }

  std::mt19937& random_;
  std::vector<gcode::Block> blocks_;
  Vec3 at_ = Vec3::Zero();
  double heading_ = 0.0;
  double feedrate_ = 50.0;
  gcode::PathMode mode_ = gcode::PathMode::kContinuous;
};

}  // namespace

std::vector<gcode::Block> random_program(std::mt19937& random, int pieces) {
  Writer writer(random);
  for (int i = 0; i < pieces; ++i) {
    writer.write_piece();
  }
  return writer.take();
}

}  // namespace twin::test
