#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "programs.hpp"

namespace twin::studies::convert {
namespace bspline_test {

/// A spline of a SINUMERIK program, as a control has it.
struct Spline {
  int degree = 3;
  std::vector<Vec3> points;     // the position before it first
  std::vector<double> weights;  // the same
  std::vector<double> spans;    // PL, of points 1 and on
};

/// Splines of a program: words are separated by blanks, an address of two letters has '='.
std::vector<Spline> read_splines(const std::string& text) {
  std::vector<Spline> splines;
  std::istringstream lines(text);
  std::string line;
  Vec3 position = Vec3::Zero();
  bool is_spline = false;
  while (std::getline(lines, line)) {
    std::istringstream words(line.substr(0, line.find(';')));
    std::map<std::string, double> values;
    std::string word;
    while (words >> word) {
      if (word == "BSPLINE") {
        is_spline = true;
        splines.push_back({3, {position}, {1.0}, {}});
      } else if (const auto equals = word.find('='); equals != std::string::npos) {
        values[word.substr(0, equals)] = std::stod(word.substr(equals + 1));
      } else if (word[0] == 'G' && std::stod(word.substr(1)) < 4) {
        is_spline = false;
      } else {
        values[word.substr(0, 1)] = std::stod(word.substr(1));
      }
    }
    if (values.count("SD") != 0) {
      splines.back().degree = static_cast<int>(values["SD"]);
    }
    if (values.count("X") + values.count("Y") + values.count("Z") == 0) {
      continue;
    }
    position = {values.count("X") != 0 ? values["X"] : position.x(),
                values.count("Y") != 0 ? values["Y"] : position.y(),
                values.count("Z") != 0 ? values["Z"] : position.z()};
    if (is_spline) {
      splines.back().points.push_back(position);
      splines.back().weights.push_back(values.count("PW") != 0 ? values["PW"] : 1.0);
      splines.back().spans.push_back(values.at("PL"));
    }
  }
  return splines;
}

std::vector<double> knots_of(const Spline& spline) {
  std::vector<double> knots(static_cast<std::size_t>(spline.degree) + 1, 0.0);
  for (std::size_t i = 0;
       i + 1 + static_cast<std::size_t>(spline.degree) < spline.points.size() + 1; ++i) {
    knots.push_back(knots.back() + spline.spans[i]);
  }
  while (knots.size() < spline.points.size() + static_cast<std::size_t>(spline.degree) + 1) {
    knots.push_back(knots.back());
  }
  return knots;
}

/// N_{i,p}(u), from the definition.
double basis(const std::vector<double>& t, std::size_t i, int p, double u) {
  if (p == 0) {
    const bool is_last = u == t.back() && t[i] < u && t[i + 1] == u;
    return (t[i] <= u && u < t[i + 1]) || is_last ? 1.0 : 0.0;
  }
  const auto d = static_cast<std::size_t>(p);
  double sum = 0.0;
  if (t[i + d] > t[i]) {
    sum += (u - t[i]) / (t[i + d] - t[i]) * basis(t, i, p - 1, u);
  }
  if (t[i + d + 1] > t[i + 1]) {
    sum += (t[i + d + 1] - u) / (t[i + d + 1] - t[i + 1]) * basis(t, i + 1, p - 1, u);
  }
  return sum;
}

Vec3 evaluate(const Spline& spline, const std::vector<double>& knots, double u) {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < spline.points.size(); ++i) {
    const double share = spline.weights[i] * basis(knots, i, spline.degree, u);
    sum += share * spline.points[i];
    weight += share;
  }
  return sum / weight;
}

TEST(Bspline, IsTheFittedCurveForAControlThatReadsItsWords) {
  for (const std::string name : {"dolphin.nc", "mixed.nc"}) {
    std::vector<geometry::Curve> fitted;
    for (const path::Segment& segment : test::segments_of(name)) {
      if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
        fitted.push_back(curve->curve);
      }
    }
    const auto splines = read_splines(test::convert_file(name, "bspline").text);
    ASSERT_EQ(splines.size(), fitted.size());
    for (std::size_t k = 0; k < splines.size(); ++k) {
      const std::vector<double> knots = knots_of(splines[k]);
      ASSERT_NEAR(knots.back(), fitted[k].u_max(), 1e-4);
      for (int i = 0; i <= 40; ++i) {
        const Vec3 place =
            evaluate(splines[k], knots, std::min(knots.back(), knots.back() * i / 40.0));
        const Vec3 expected = fitted[k].position(fitted[k].u_max() * i / 40.0);
        ASSERT_LT((place - expected).norm(), 2e-5) << name << " curve " << k << " of " << i;
      }
    }
  }
}

TEST(Bspline, WeightsAreDividedByTheFirst) {
  const auto conversion = test::convert_text(
      "F600 G0 X0\nG06.2 P3 K0 R2\nK0 X5 Y5 R1\nK0 X10 Y0 R4\nK1\nK1\nK1\nM30\n", "bspline");
  ASSERT_TRUE(conversion) << to_string(conversion.error());
  const auto splines = read_splines(conversion->text);
  ASSERT_EQ(splines.size(), 1U);
  EXPECT_EQ(splines[0].degree, 2);
  EXPECT_EQ(splines[0].weights, (std::vector<double>{1.0, 0.5, 2.0}));
  const Vec3 middle = evaluate(splines[0], knots_of(splines[0]), 0.5);
  const double w = 0.25 * 1.0 + 0.5 * 0.5 + 0.25 * 2.0;
  EXPECT_NEAR(middle.x(), (0.5 * 0.5 * 5.0 + 0.25 * 2.0 * 10.0) / w, 1e-9);
  EXPECT_NEAR(middle.y(), 0.5 * 0.5 * 5.0 / w, 1e-9);
}

}  // namespace bspline_test
}  // namespace twin::studies::convert
