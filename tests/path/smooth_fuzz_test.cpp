#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/path/smooth_path.hpp"

namespace twin::path {
namespace smooth_fuzz_test {

using test::arc_block;
using test::expect_marks;
using test::expect_smooth_joints;
using test::expect_within_bounds;
using test::is_finite;
using test::line_block;
using test::smooth;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double log_uniform(std::mt19937& random, double low, double high) {
  return low * std::pow(high / low, uniform(random, 0.0, 1.0));
}

/// A program of stretches of different kinds, each blocks of one character.
class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : random_(seed) {
    if (uniform(random_, 0.0, 1.0) < 0.2) {
      at_ = Vec3(uniform(random_, -5000.0, 5000.0), 3000.0, -100.0);
    }
    const int stretches = std::uniform_int_distribution<int>(1, 5)(random_);
    for (int i = 0; i < stretches; ++i) {
      add_stretch();
    }
  }

  const std::vector<gcode::Block>& blocks() const { return blocks_; }

 private:
  void add_line(double length, double turn, double climb = 0.0) {
    heading_ += turn;
    const Vec3 end =
        at_ + length * Vec3(std::cos(heading_), std::sin(heading_), climb).normalized();
    blocks_.push_back(line_block(at_, end, feedrate_));
    blocks_.back().tolerance = tolerance_;
    blocks_.back().line = static_cast<std::int64_t>(blocks_.size());
    at_ = end;
  }

  void add_arc() {
    const double sweep = uniform(random_, 0.1, 5.0);
    const bool is_left = uniform(random_, 0.0, 1.0) < 0.5;
    heading_ += uniform(random_, 0.0, 1.0) < 0.5 ? 0.0 : uniform(random_, -2.0, 2.0);
    blocks_.push_back(arc_block(at_, {std::cos(heading_), std::sin(heading_), 0.0},
                                log_uniform(random_, 0.05, 50.0), sweep, is_left, feedrate_,
                                uniform(random_, 0.0, 1.0) < 0.3 ? 0.5 : 0.0));
    heading_ += is_left ? sweep : -sweep;
    at_ = blocks_.back().end;
  }

  void add_stretch() {
    const int count = std::uniform_int_distribution<int>(1, 60)(random_);
    const int kind = std::uniform_int_distribution<int>(0, 11)(random_);
    const double length = log_uniform(random_, 0.002, 3.0);
    const double radius = log_uniform(random_, 0.02, 100.0);
    if (uniform(random_, 0.0, 1.0) < 0.3) {
      feedrate_ = uniform(random_, 1.0, 100.0);
    }
    if (uniform(random_, 0.0, 1.0) < 0.2) {
      tolerance_ = uniform(random_, 0.0, 1.0) < 0.5 ? 0.0 : log_uniform(random_, 0.001, 0.1);
    }
    for (int i = 0; i < count; ++i) {
      switch (kind) {
        case 0:  // round
          add_line(length, length / radius);
          break;
        case 1:  // alternating long and short
          add_line(i % 2 == 0 ? 0.01 : 5.0, uniform(random_, -0.01, 0.01));
          break;
        case 2:  // zigzag
          add_line(0.1, i % 2 == 0 ? 1.5708 : -1.5708);
          break;
        case 3:  // there and back
          add_line(length, i % 3 == 2 ? 3.14159265 : 0.001);
          break;
        case 4:  // anything
          add_line(log_uniform(random_, 1e-3, 20.0), uniform(random_, -3.14, 3.14));
          break;
        case 5:  // spiral of 20 um pitch
          add_line(0.02, 0.02 / (0.02 + 0.02 * i / 6.28));
          break;
        case 6:  // noisy
          add_line(0.02, uniform(random_, -0.05, 0.05));
          break;
        case 7:  // helix
          add_line(length, length / radius, 0.3);
          break;
        case 8:  // specks
          add_line(log_uniform(random_, 1e-6, 1e-2), uniform(random_, -3.14, 3.14));
          break;
        case 9:  // specks on a line
          add_line(i % 4 == 0 ? 1.0 : log_uniform(random_, 1e-6, 1e-4),
                   uniform(random_, -0.3, 0.3));
          break;
        case 10:
          add_arc();
          i += 9;
          break;
        default:  // mixed lengths on a wave
          add_line(log_uniform(random_, 1e-3, 2.0), uniform(random_, -0.2, 0.2));
      }
    }
  }

  std::mt19937 random_;
  std::vector<gcode::Block> blocks_;
  Vec3 at_ = Vec3::Zero();
  double heading_ = 0.3;
  double feedrate_ = 50.0;
  double tolerance_ = 0.0;
};

double largest_tolerance(const std::vector<gcode::Block>& blocks) {
  double largest = 0.0;
  for (const gcode::Block& block : blocks) {
    largest = std::max(largest, block.tolerance > 0.0 ? block.tolerance : 0.01);
  }
  return largest;
}

TEST(SmoothFuzz, RandomProgramsKeepTheirPromises) {
  const char* many = std::getenv("TWIN_FUZZ_PROGRAMS");
  const unsigned count = many != nullptr ? static_cast<unsigned>(std::atoi(many)) : 25U;
  for (unsigned seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const RandomProgram program(seed);
    const auto segments = smooth(program.blocks());
    for (const Segment& segment : segments) {
      ASSERT_TRUE(is_finite(segment));
    }
    expect_smooth_joints(segments);
    expect_marks(segments, static_cast<std::int64_t>(program.blocks().size()));
    expect_within_bounds(segments, program.blocks(), largest_tolerance(program.blocks()));
    if (HasFatalFailure()) {
      return;
    }
  }
}

}  // namespace smooth_fuzz_test
}  // namespace twin::path
