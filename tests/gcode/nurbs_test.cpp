#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "gcode/block.hpp"
#include "program.hpp"

namespace twin::gcode {
namespace nurbs_test {

using testing::HasSubstr;

const std::string kStart = "G01 F600 X1\n";

std::string uniform(const std::string& lines) { return kStart + "G05.2 P1 L4\n" + lines; }
std::string with_knots(const std::string& lines) { return kStart + "G06.2 P3\n" + lines; }

TEST(ReadNurbs, QuarterCircleByRationalParabolaIsACircle) {
  const auto blocks = blocks_of(fmt::format(
      "G01 F600 X5 Y0\nG06.2 P3 K0 X5 Y0 R1\nK0 X5 Y5 R{:.15f}\nK0 X0 Y5 R1\nK1\nK1\nK1\nM30\n",
      std::sqrt(0.5)));
  ASSERT_EQ(blocks.size(), 2U);
  const geometry::Curve& curve = blocks[1].nurbs->curve;
  for (int i = 0; i <= 100; ++i) {
    EXPECT_NEAR(curve.position(0.01 * i).norm(), 5.0, 1e-12);
  }
  EXPECT_NEAR(blocks[1].nurbs->arc_length.length(), 2.5 * std::numbers::pi, 1e-9);
}

TEST(ReadNurbs, FourUniformControlPointsOfOrderFourAreABezierCurve) {
  const auto blocks = blocks_of(uniform("X1 Y2 P1\nX3 Y2 P1\nX3 Y0 P1\nG05.3\n"));
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[1].motion, Motion::kNurbs);
  EXPECT_EQ(blocks[1].line, 2);
  EXPECT_EQ(blocks[1].start, Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(blocks[1].end, Vec3(3.0, 0.0, 0.0));
  EXPECT_EQ(blocks[1].feedrate, 10.0);
  const geometry::Curve& curve = blocks[1].nurbs->curve;
  for (int i = 0; i <= 10; ++i) {
    const double u = 0.1 * i;
    const double v = 1.0 - u;
    const Vec3 expected = v * v * v * Vec3(1, 0, 0) + 3.0 * u * v * v * Vec3(1, 2, 0) +
                          3.0 * u * u * v * Vec3(3, 2, 0) + u * u * u * Vec3(3, 0, 0);
    EXPECT_LT((curve.position(u) - expected).norm(), 1e-14) << u;
  }
}

TEST(ReadNurbs, KnotsOfG052AreUniformAndClamped) {
  const auto blocks = blocks_of(kStart + "G5.2 L3 P1\nX2 Y1\nX3 Y0\nX4 Y1\nX5 Y3\nG5.3\n");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[1].nurbs->curve.degree(), 2);
  EXPECT_EQ(blocks[1].nurbs->curve.knots(), (std::vector<double>{0, 0, 0, 1, 2, 3, 3, 3}));
}

TEST(ReadNurbs, TheCurveOfLinuxCnc) {
  // Points that `rs274` 2.9 makes of these lines (gcode.parse of its Python module).
  const auto blocks =
      blocks_of("G90 G0 X0 Y0\nF600\nG5.2 P1 L4\nX1 Y2 P1\nX2 Y2 P1\nX3 Y0 P1\nX5 Y5 P1\nG5.3\n");
  ASSERT_EQ(blocks.size(), 1U);
  const geometry::Curve& curve = blocks[0].nurbs->curve;
  for (const Vec3& known :
       {Vec3(0.763553, 1.28159, 0.0), Vec3(1.39109, 1.76902, 0.0), Vec3(1.89985, 1.59289, 0.0),
        Vec3(2.40439, 1.12941, 0.0), Vec3(3.14269, 1.37193, 0.0), Vec3(4.40938, 3.59691, 0.0)}) {
    double least = 1e9;
    for (int i = 0; i <= 200000; ++i) {
      least = std::min(least, (curve.position(1e-5 * i) - known).norm());
    }
    EXPECT_LT(least, 6e-5);
  }
}

TEST(ReadNurbs, CoordinatesOfANurbsScaleWithInchesAndKnotsDoNot) {
  const auto blocks =
      blocks_of("G20 G01 F10 X1\nG06.2 P3\nK0 X2\nK0 X2 Y1\nK3\nK3\nK3\nG06.3\nG01 X3\n");
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[1].end, Vec3(50.8, 25.4, 0.0));
  EXPECT_EQ(blocks[1].nurbs->curve.u_max(), 3.0);
  EXPECT_EQ(blocks[2].start, blocks[1].end);
}

TEST(ReadNurbs, OneEndsWhereTheNextBegins) {
  constexpr std::string_view kOne = "G06.2 P3\nK0 X{0}\nK0 X{0} Y{0}\nK1\nK1\nK1\n";
  const auto blocks = blocks_of(kStart + fmt::format(kOne, 2) + fmt::format(kOne, 3));
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[2].start, blocks[1].end);
  EXPECT_EQ(blocks[2].line, 8);
}

TEST(ReadNurbs, WordsBetweenCurvesMeanWhatTheyAlwaysMean) {
  const auto blocks =
      blocks_of(with_knots("K0 X2\nK0 X2 Y1\nK1\nK1\nK1\nM3 S100\nG04 P1\nM0\nG64 P0.1\nG0 X0\n"));
  ASSERT_EQ(blocks.size(), 5U);
  EXPECT_EQ(blocks[2].motion, Motion::kDwell);
  EXPECT_EQ(blocks[4].tolerance, 0.1);
}

TEST(ReadNurbs, UnfinishedIsToldAtItsBeginning) {
  EXPECT_EQ(error_of(uniform("X1 Y2 P1\nX3 Y2\nX3 Y0\n")),
            "line 2:1: the G05.2 that begins here has no G05.3 where the program ends");
  EXPECT_EQ(error_of(uniform("X1 Y2 P1\nX3 Y2\nX3 Y0\nM30\n")),
            "line 2:1: the G05.2 that begins here has no G05.3 where an M word comes");
  EXPECT_EQ(error_of(uniform("X1 Y2\nG01 X3\n")),
            "line 2:1: the G05.2 that begins here has no G05.3 where another G word of motion "
            "comes");
  EXPECT_EQ(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1\nK1\nG06.3\n")),
            "line 2:1: the G06.2 that begins here has 3 control points of rank 3 and 5 knots, "
            "which is 1 too few where G06.3 comes");
}

TEST(ReadNurbs, TooFewControlPoints) {
  EXPECT_EQ(error_of(uniform("X1 Y2 P1\nX3 Y2\nG05.3\n")),
            "line 5:1: 3 control points, the position before the G05.2 of line 2 among them: "
            "expected 4 or more for that order");
  EXPECT_THAT(error_of(with_knots("K0 X2\nK1\n")), HasSubstr("line 4:1: 2 control points"));
}

TEST(ReadNurbs, OrderOutOfRange) {
  EXPECT_EQ(error_of(kStart + "G05.2 L2\n"),
            "line 2:7: L2 (order, degree + 1): expected a whole number from 3 to 6");
  EXPECT_THAT(error_of(kStart + "G05.2 L7\n"), HasSubstr("expected a whole number from 3 to 6"));
  EXPECT_THAT(error_of(kStart + "G06.2 P1\n"), HasSubstr("from 2 to 6"));
  EXPECT_THAT(error_of(kStart + "G06.2 P3.5\n"), HasSubstr("line 2:7: P3.5 (order"));
}

TEST(ReadNurbs, KnotsThatDescendOrOccurTooOftenOrTooSeldom) {
  EXPECT_EQ(
      error_of(with_knots("K0 X2\nK0 X2 Y1\nK1 X3\nK0.5 X4\n")),
      "line 6:1: knot K0.5, number 5 of rank 3: expected not less than the one before it, K1");
  EXPECT_THAT(
      error_of(with_knots("K0 X2\nK0.5 X2 Y1\n")),
      HasSubstr("line 4:1: knot K0.5, number 3 of rank 3: expected K0, for the first knot"));
  EXPECT_THAT(error_of(with_knots("K0 X2\nK0 X2 Y1\nK0 X3\n")),
              HasSubstr("line 5:1: knot K0, number 4 of rank 3: expected a greater one"));
  EXPECT_THAT(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1 X3\nK1 X4\nK1 X5\n")),
              HasSubstr("line 7:1: knot K1, number 6 of rank 3: expected a greater one"));
  EXPECT_THAT(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1 X3\nK1\nK1\nK1\n")),
              HasSubstr("line 6:1: knot K1, number 5 of rank 3: expected a greater one"));
  EXPECT_THAT(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1\nK2\n")),
              HasSubstr("line 6:1: knot K2, number 5 of rank 3: expected K1, for the last knot"));
  EXPECT_EQ(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1\nK1\nK1\nK1\n")),
            "line 8:1: the NURBS of line 2 is complete: expected a G word of motion");
  EXPECT_THAT(error_of(with_knots("K0 X2\nX2 Y1\n")), HasSubstr("line 4:1: no knot"));
  EXPECT_THAT(error_of(with_knots("K0 X2\nK0 X2 Y1\nK1\nK1 X3\n")),
              HasSubstr("line 6:4: a control point behind a knot alone"));
}

TEST(ReadNurbs, WeightsThatAreNoWeights) {
  EXPECT_EQ(error_of(uniform("X1 Y2 P0\n")), "line 3:7: weight P0: expected 0.0001 to 10000");
  EXPECT_THAT(error_of(with_knots("K0 X2 R-1\n")), HasSubstr("line 3:7: weight R-1"));
  EXPECT_THAT(error_of(with_knots("K0 R2\n")),
              HasSubstr("line 3:4: a weight without a control point"));
  EXPECT_THAT(error_of(uniform("P2\n")), HasSubstr("line 3:1: P without X and Y"));
}

TEST(ReadNurbs, WordsThatDoNotBelong) {
  EXPECT_EQ(error_of(uniform("X1 Y2 Z1\n")),
            "line 3:7: Z does not belong on this line of the G05.2 of line 2");
  EXPECT_THAT(error_of(uniform("X1 Y2 F100\n")), HasSubstr("line 3:7: F does not belong"));
  EXPECT_THAT(error_of(uniform("X1\n")),
              HasSubstr("line 3:1: a control point of G05.2 needs both"));
  EXPECT_THAT(error_of(uniform("G20 X1 Y2\n")), HasSubstr("line 3:1: a G word within the G05.2"));
  EXPECT_THAT(error_of(with_knots("K0 X2 I1\n")), HasSubstr("line 3:7: I does not belong"));
  EXPECT_THAT(error_of("G01 X1 F1 L2\n"), HasSubstr("line 1:11: L (repeat count"));
  EXPECT_THAT(error_of(uniform("X1 Y2\nX2 Y2\nX3 Y0\nG05.3 X1\n")),
              HasSubstr("line 6:7: a word beside the end of a NURBS"));
  EXPECT_THAT(error_of("G01 X1 F1\nG05.2 M3\n"), HasSubstr("line 2:1: an M word beside a NURBS"));
}

TEST(ReadNurbs, ModesInWhichThereIsNone) {
  EXPECT_EQ(
      error_of("F600 G41.1 D1\nG05.2\n"),
      "line 2:1: a NURBS with G41, G42, G16 or G93 in force: expected G40, G15 and G94, and a "
      "straight move behind G40");
  EXPECT_EQ(error_of("F600 G61\nG06.2\n"),
            "line 2:1: G06.2 with G61 (exact stop) in force: expected G64");
  EXPECT_EQ(error_of("F600\nG91 G06.2\n"),
            "line 2:5: G06.2 with G91 in force: expected G90, absolute control points");
  EXPECT_EQ(error_of("G06.2\n"),
            "line 1:1: G06.2 has no feedrate: expected an F word on this line or before it");
}

TEST(ReadNurbs, EndsWithoutABeginning) {
  EXPECT_EQ(error_of("G05.3\n"), "line 1:1: G05.3 without G05.2 before it");
  EXPECT_EQ(error_of("G06.3\n"), "line 1:1: G06.3 without G06.2 before it");
  EXPECT_EQ(error_of(uniform("X1 Y2\nX2 Y2\nX3 Y0\nG06.3\n")),
            "line 6:1: G06.3 without G06.2 before it");
}

TEST(ReadNurbs, FirstControlPointElsewhere) {
  EXPECT_EQ(error_of(kStart + "G06.2 P3 K0 X1 Y0.5\n"),
            "line 2:13: the first control point is 0.5 mm away from the position before: expected "
            "the same place");
}

TEST(ReadNurbs, CurvesWithoutTangentOrLength) {
  EXPECT_THAT(error_of(uniform("X1 Y0\nX1 Y0\nX1 Y0\nG05.3\n")), HasSubstr("has no length"));
  EXPECT_THAT(error_of(uniform("X1 Y0\nX1 Y0\nX2 Y2\nX3 Y0\nG05.3\n")),
              HasSubstr("line 7:1: the NURBS has no tangent at parameter 0"));
  // The control polygon of a cubic with a cusp in its middle is a symmetric bow tie.
  EXPECT_THAT(error_of("F600 G0 X0 Y0\nG05.2 L4\nX1 Y1 P1\nX0 Y1 P1\nX1 Y0 P1\nG05.3\n"),
              HasSubstr("line 6:1: the NURBS has no tangent at parameter 0.5"));
}

TEST(ReadNurbs, AbsurdSizes) {
  EXPECT_THAT(error_of(uniform("X1e\n")), HasSubstr("line 3:"));
  EXPECT_THAT(error_of(uniform("X100001 Y0\n")), HasSubstr("line 3:1: a control point farther"));
  std::string many = kStart + "G05.2 L4\n";
  for (int i = 0; i < 100001; ++i) {
    many += fmt::format("X{} Y{} P1\n", 2 + i % 7, i % 3);
  }
  EXPECT_THAT(error_of(many), HasSubstr("more than 100000 control points in one NURBS"));
}

}  // namespace nurbs_test
}  // namespace twin::gcode
