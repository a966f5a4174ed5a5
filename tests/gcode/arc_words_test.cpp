#include "gcode/interpreter/arc_words.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "program.hpp"

namespace twin::gcode {
namespace arc_words_test {

constexpr double kPi = std::numbers::pi;

Block only_block(const std::string& text) {
  const auto blocks = blocks_of(text);
  EXPECT_EQ(blocks.size(), 1U) << text;
  return blocks.empty() ? Block{} : blocks[0];
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

/// A frame that is orthonormal, and ends that lie on the arc.
void expect_sound(const Block& block) {
  const geometry::Arc& arc = block.arc;
  const double scale = block.start.norm() + block.end.norm() + arc.radius + std::abs(arc.rise);
  EXPECT_NEAR(arc.e1.norm(), 1.0, 1e-14);
  EXPECT_NEAR(arc.e2.norm(), 1.0, 1e-14);
  EXPECT_NEAR(arc.e1.dot(arc.e2), 0.0, 1e-14);
  EXPECT_GT(arc.radius, 0.0);
  EXPECT_GT(arc.sweep, 0.0);
  EXPECT_LE(arc.sweep, 2.0 * kPi);
  expect_near(point_at(arc, 0.0), block.start, 1e-12 * scale);
  expect_near(point_at(arc, 1.0), block.end, 1e-12 * scale);
}

TEST(Arc, QuarterCirclesInTheThreePlanesPassTheirMiddle) {
  const double m = std::sqrt(0.5);
  const struct {
    const char* text;
    Vec3 middle;
    Vec3 normal;
  } cases[] = {
      {"G17 G3 X-10 Y10 I-10 F1", Vec3(10 * m - 10, 10 * m, 0), Vec3::UnitZ()},
      {"G17 G2 X-10 Y-10 I-10 F1", Vec3(10 * m - 10, -10 * m, 0), -Vec3::UnitZ()},
      {"G18 G3 Z-10 X10 K-10 F1", Vec3(10 * m, 0, 10 * m - 10), Vec3::UnitY()},
      {"G18 G2 Z-10 X-10 K-10 F1", Vec3(-10 * m, 0, 10 * m - 10), -Vec3::UnitY()},
      {"G19 G3 Y-10 Z10 J-10 F1", Vec3(0, 10 * m - 10, 10 * m), Vec3::UnitX()},
      {"G19 G2 Y-10 Z-10 J-10 F1", Vec3(0, 10 * m - 10, -10 * m), -Vec3::UnitX()},
  };
  for (const auto& c : cases) {
    const Block block = only_block(c.text);
    expect_sound(block);
    EXPECT_NEAR(block.arc.sweep, kPi / 2.0, 1e-15) << c.text;
    expect_near(point_at(block.arc, 0.5), c.middle, 1e-13);
    expect_near(block.arc.e1.cross(block.arc.e2), c.normal, 1e-15);
  }
}

TEST(Arc, HelixRisesEvenlyWhicheverWayItTurns) {
  for (const char* text : {"G3 X-20 I-10 Z6 F1", "G2 X-20 I-10 Z6 F1", "G2 I-10 Z6 F1"}) {
    const Block block = only_block(text);
    expect_sound(block);
    EXPECT_NEAR(point_at(block.arc, 0.25).z(), 1.5, 1e-14) << text;
    EXPECT_EQ(block.arc.centre.z(), 0.0) << text;
  }
}

TEST(Arc, FullCircleComesBackToItsStart) {
  for (const char* text : {"G2 I3 J4 F1", "G3 X0 Y0 I3 J4 F1", "G91 G3 X0 I-3 J4 F1"}) {
    const Block block = only_block(text);
    expect_sound(block);
    EXPECT_EQ(block.arc.sweep, 2.0 * kPi) << text;
    EXPECT_EQ(block.arc.radius, 5.0) << text;
    EXPECT_EQ(block.end, block.start) << text;
    expect_near(point_at(block.arc, 0.5), 2.0 * block.arc.centre, 1e-14);
  }
}

TEST(Arc, EndsARoundingErrorApartAreAFullCircleEitherWay) {
  const double third = 1.0 / 3.0;
  for (const double off : {-2e-13, 2e-13}) {
    for (const bool is_clockwise : {false, true}) {
      const ArcEnds ends{Vec3(third, 0, 0), Vec3(third, off, 0), Plane::kXy, is_clockwise};
      const auto arc = arc_by_offset(ends, Vec3(-10.0, 0, 0));
      ASSERT_TRUE(arc.has_value());
      EXPECT_EQ(arc->geometry.sweep, 2.0 * kPi);
      EXPECT_EQ(arc->end, ends.start);
    }
  }
}

TEST(Arc, ShortArcOfALargeCircleKeepsItsLength) {
  const Block block = only_block("G3 X-0.0000005 Y0.001 I-1000000 F1");
  expect_sound(block);
  EXPECT_NEAR(block.arc.sweep * block.arc.radius, 0.001, 1e-12);
}

TEST(Arc, RadiusSignChoosesTheShortOrTheLongWay) {
  const Block shorter = only_block("G2 X10 Y10 R10 F1");
  EXPECT_NEAR(shorter.arc.sweep, kPi / 2.0, 1e-14);
  expect_near(shorter.arc.centre, Vec3(10, 0, 0), 1e-13);
  const Block longer = only_block("G2 X10 Y10 R-10 F1");
  EXPECT_NEAR(longer.arc.sweep, 1.5 * kPi, 1e-14);
  expect_near(longer.arc.centre, Vec3(0, 10, 0), 1e-13);
  expect_near(only_block("G3 X10 Y10 R10 F1").arc.centre, Vec3(0, 10, 0), 1e-13);
}

TEST(Arc, RadiusAHairTooSmallMakesAHalfCircle) {
  const Block block = only_block("G3 X20 R9.981 F1");
  expect_sound(block);
  EXPECT_EQ(block.arc.radius, 10.0);
  EXPECT_NEAR(block.arc.sweep, kPi, 1e-15);
  expect_near(point_at(block.arc, 0.5), Vec3(10, -10, 0), 1e-13);
}

TEST(Arc, RoundedEndChangesTheRadiusEvenly) {
  const Block block = only_block("G3 X-20.015 Y0 I-10 F1");
  expect_sound(block);
  EXPECT_NEAR(block.arc.radius_change, 0.015, 1e-14);
  EXPECT_NEAR((point_at(block.arc, 0.5) - block.arc.centre).norm(), 10.0075, 1e-13);
}

TEST(Arc, ImpossibleArcsAreRefused) {
  EXPECT_EQ(error_of("G2 X1 F1"), "line 1:4: G02 has no centre: expected I and J, or R");
  EXPECT_EQ(error_of("G2 X1 I1 R1 F1"),
            "line 1:10: R beside I, J or K: expected I and J, or R, not both");
  EXPECT_EQ(error_of("G2 X1 K1 F1"),
            "line 1:7: K does not belong to the plane of G17: expected I and J");
  EXPECT_EQ(error_of("G18 G2 X1 J1 F1"),
            "line 1:11: J does not belong to the plane of G18: expected I and K");
  EXPECT_EQ(error_of("G19 G2 Y1 I1 F1"),
            "line 1:11: I does not belong to the plane of G19: expected J and K");
  EXPECT_EQ(error_of("G2 X1 I0 F1"),
            "line 1:7: the centre of the arc is its start: expected a radius above zero");
  EXPECT_EQ(error_of("G2 X1 I1 R0 F1"),
            "line 1:10: R beside I, J or K: expected I and J, or R, not both");
  EXPECT_EQ(error_of("G2 X1 R0 F1"),
            "line 1:7: the arc's radius is zero: expected R other than zero");
  EXPECT_EQ(error_of("G2 R5 F1"),
            "line 1:4: an arc with R from a point to itself has no centre: expected I J K");
  EXPECT_EQ(error_of("G2 X20 R9.9 F1"),
            "line 1:8: an arc of radius 9.9 mm cannot span 20 mm: expected R of at least 10 mm");
  EXPECT_EQ(error_of("G2 X20 I9 F1"),
            "line 1:8: the arc's radius is 9 mm at its start and 11 mm at its end: expected the "
            "same within 0.0283 mm or 0.1 %");
}

TEST(Arc, RadiusMismatchIsAllowedToWhatThePeerTakes) {
  EXPECT_EQ(blocks_of("G3 X-10.028 I-5 F1").size(), 1U);
  EXPECT_NE(error_of("G3 X-10.029 I-5 F1"), "");
  EXPECT_EQ(blocks_of("G3 X-200.099 I-100 F1").size(), 1U);
  EXPECT_NE(error_of("G3 X-200.101 I-100 F1"), "");
  EXPECT_EQ(blocks_of("G20 G3 X-0.4028 I-0.2 F1").size(), 1U);
  EXPECT_NE(error_of("G20 G3 X-0.4029 I-0.2 F1"), "");
}

/// Angle from start to end seen from the centre, by the difference of two angles.
double turn_by_angles(const Vec2& from, const Vec2& to, bool is_clockwise) {
  const double turn = std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x());
  const double forward = is_clockwise ? -turn : turn;
  return forward - 2.0 * kPi * std::floor(forward / (2.0 * kPi));
}

TEST(Arc, RandomArcsAgreeWithAnglesAndLandOnTheirEnds) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  std::uniform_real_distribution<double> angle(0.05, 2.0 * kPi - 0.05);
  for (int i = 0; i < 20000; ++i) {
    const bool is_clockwise = i % 2 == 0;
    const Vec2 centre(place(random), place(random));
    const double radius = std::pow(10.0, place(random) / 40.0);
    const double from = place(random);
    const double to = from + (is_clockwise ? -1.0 : 1.0) * angle(random);
    const Vec2 u = radius * Vec2(std::cos(from), std::sin(from));
    const Vec2 v = (radius + 1e-4) * Vec2(std::cos(to), std::sin(to));
    ArcEnds ends{{}, {}, Plane::kXy, is_clockwise};
    ends.start << centre + u, place(random);
    ends.end << centre + v, place(random);
    Vec3 offset = Vec3::Zero();
    offset << -u, 0.0;
    const auto arc = arc_by_offset(ends, offset);
    ASSERT_TRUE(arc.has_value());
    Block block;
    block.start = ends.start;
    block.end = arc->end;
    block.arc = arc->geometry;
    expect_sound(block);
    ASSERT_NEAR(block.arc.sweep, turn_by_angles(u, v, is_clockwise), 1e-9);
    ASSERT_EQ(block.arc.e1.cross(block.arc.e2).z() > 0.0, !is_clockwise);
  }
}

TEST(Arc, ByRadiusIsTheArcByOffset) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  std::uniform_real_distribution<double> angle(0.1, 2.0 * kPi - 0.1);
  for (int i = 0; i < 20000; ++i) {
    const Plane plane = static_cast<Plane>(i % 3);
    const bool is_clockwise = i % 2 == 0;
    const double radius = 0.1 + std::abs(place(random));
    const double sweep = angle(random);
    const double from = place(random);
    const double to = from + (is_clockwise ? -sweep : sweep);
    const auto in_space = [plane](double a, double b, double c) {
      return plane == Plane::kXy   ? Vec3(a, b, c)
             : plane == Plane::kZx ? Vec3(b, c, a)
                                   : Vec3(c, a, b);
    };
    const Vec3 u = in_space(radius * std::cos(from), radius * std::sin(from), 0.0);
    const Vec3 v = in_space(radius * std::cos(to), radius * std::sin(to), place(random));
    const Vec3 centre(place(random), place(random), place(random));
    const ArcEnds ends{centre + u, centre + v, plane, is_clockwise};
    const auto by_offset = arc_by_offset(ends, -u);
    const auto by_radius = arc_by_radius(ends, sweep < kPi ? radius : -radius);
    ASSERT_TRUE(by_offset && by_radius);
    // Near half a turn the centre hangs on the square root of a small difference.
    const double tolerance = std::abs(sweep - kPi) < 0.01 ? 1e-5 : 1e-9;
    for (const double fraction : {0.0, 0.3, 0.7, 1.0}) {
      expect_near(point_at(by_radius->geometry, fraction), point_at(by_offset->geometry, fraction),
                  tolerance);
    }
  }
}

}  // namespace arc_words_test
}  // namespace twin::gcode
