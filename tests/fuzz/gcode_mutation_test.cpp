#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#include "gcode/block.hpp"
#include "gcode/reader.hpp"

namespace twin::gcode {
namespace gcode_mutation_test {

using Random = std::mt19937_64;

constexpr std::size_t kMutants = 60000;
constexpr std::size_t kMostLines = 300;  // that loops may execute again

constexpr std::string_view kSeeds[] = {
    "%\n(seed)\nG21 G90 G17\nN10 G00 X1 Y2\nG01 Z-1 F300\nX5.125 Y-3.5\nG02 X10 Y0 I2.5 J1.5\n"
    "G03 X0 R20\nG02 I5 Z2\nG04 P0.5\nM30\n%\n",
    "G20 G91 G64 P0.001\r\nG1X.1Y.1F60S1000M3\r\nG61\r\nG18 G2 X1 Z1 R1\r\n/G19 G3 Y1 K1\r\nM0\r\n",
    "G01 F600 X1\nG05.2 P1 L4\nX1 Y2 P1\nX3 Y2 P2\nX3 Y0 P1\nX5 Y1 P1\nG05.3\n"
    "G06.2 P3 K0 X5 Y1 R1\nK0 X7 Y1 R0.5\nK0 X7 Y3\nK0.5 Z1 X8\nK1\nK1\nK1\nG06.3\nM30\n",
    "T1M6\nG43H1Z5\nG81X1Y1Z-1R1F60\nG91X2L3\nG90G83X9Z-2Q.7R1\nG82X3P.1\nG80\nG28G91Z0\nG90\n"
    "G53G0X3\nG10L2P2X1R30\nG55X1Y1\nG92X0\nG2X1I1P2\nG68X0Y0R45\nG0X1Y2\nG69\nX1Y1\nG51.1X2\n"
    "G1X3Y1Z1\nG50.1\nX0Y0\nM2\n",
    "G0X0Y0F100\nG42.1D2X10\nG1X20Y10\nG3X10Y20R10\nG4P.1\nZ1\nX0\nG2X-5Y15J-5\nG1Y0\nG40X-9\n"
    "G5X1Y1I0J3P0Q-3\nG5.1X9I2J-8\nG93G1X1F2\nG94F9G16X5Y30\nG15\nM30\n",
    "G0 F100\n#1=0 #<a>=2\no1 while [#1 LT 9]\nX[#1*2] Y-#<a>\n#1=[#1+1]\no1 endwhile\n"
    "o2 sub\nX#1 Y[SIN[30]**2]\no2 return [#1]\no2 endsub\no2 call [3] [4]\n"
    "o3 if [#<_value> EQ 3]\nX1\no3 elseif [1]\nX2\no3 else\nX3\no3 endif\n"
    "o4 repeat [3]\no4 continue\no4 endrepeat\no5 do\no5 break\no5 while [0]\n(DEBUG, %d#1)\nM2\n",
    "%\nO1 (main)\nG0\n#100=1\nWHILE[#100LT4]DO1\nX#100\n#100=#100+1\nEND1\n"
    "IF[#100EQ4]THEN#2=3\nN5 IF[#2GT9]GOTO6\n#2=#2+3\nGOTO5\nN6 M98 P2 L3\nM30\nO2\nG91X1\n"
    "M99\n%\n",
    "G0@10^30F100\nG91G81@1^60R1Z-1L3\nG90G80\nM70\nG20G55G91F1\nM72\n(c)o1 sub\nM73\nG91X1\n"
    "o1 endsub\no1 callsub\nM71\nM41P1\nF#<_hal[a.b]>\nX EXISTS[#5]Y1\nF0\nM2\n",
    "O1\nG65P9A1B2X3\nG66P9Y4\nG0X1\nG67\nX#1Y#0\nIF[#1EQ#0]GOTO7\nN7X5\nM30\nO9\nG0Y#25\nX[#1+#24]"
    "\n"
    "IF[#2NE#0]THEN#100=#2\nM99\n",
    "\xEF\xBB\xBFg0 x1;end\rg1 y2 f100 (c)\rg80\rg40 g49 g54 g94\rg1 x3 t1 m6\rm2\r",
};

constexpr std::string_view kFragments[] = {
    "#1=[",     "#<a>",       "o1 endwhile\n",
    "o1 if",    "GOTO5",      "END1\n",
    "M98P2",    "M99\n",      "O2\n",
    "**",       "ATAN[1]/[",  "EXISTS[#<a>]",
    "o2 call",  "o2 sub\n",   "N5",
    "G2",       "G3 I1",      "R-1",
    "X",        "1e9",        "999999999999",
    "-",        ".",          "(",
    ")",        ";",          "%",
    "\n%\n",    "/",          "\r",
    "\n",       "\r\n",       "#1",
    "[",        "nan",        "inf",
    "G80",      "M30",        "G91",
    "G20",      "G4 P1",      "F0",
    "I0 J0",    "K3",         "G64P",
    "\xFF",     "E",          "G1 F1 X0",
    "G5.2",     "G5.3",       "G6.2",
    "L3",       "P4",         "K1\nK1\nK1\n",
    "X1 Y1\n",  "R9",         "G6.3",
    "G41.1D1",  "G40",        "G81",
    "G10L20P1", "G43H2",      "G92Z0",
    "G68R30",   "P3",         "G28",
    "@2",       "^45",        "M70\n",
    "M72\n",    "M73\n",      "G65P9A1\n",
    "G66P9\n",  "G67",        "#0",
    "M41",      "#<_hal[a]>", "F0",
};

void mutate(std::string& text, Random& random) {
  const std::size_t at = random() % (text.size() + 1);
  switch (random() % 6) {
    case 0:
      text.insert(at, 1, static_cast<char>(random() % 256));
      break;
    case 1:
      text.erase(at, random() % 8);
      break;
    case 2:
      text.insert(at, kFragments[random() % std::size(kFragments)]);
      break;
    case 3:
      text.insert(at, text.substr(random() % (text.size() + 1), random() % 40));
      break;
    case 4:
      text.insert(at, std::string(random() % 5000, static_cast<char>('0' + random() % 12)));
      break;
    default:
      if (at < text.size()) {
        text[at] = static_cast<char>(text[at] ^ static_cast<char>(1U << (random() % 8)));
      }
  }
}

bool is_sound(const ProgrammedCurve& programmed, const Block& block) {
  const geometry::Curve& curve = programmed.curve;
  return curve.control_points().front() == block.start &&
         curve.control_points().back() == block.end && programmed.arc_length.length() > 0.0 &&
         std::isfinite(programmed.arc_length.length()) && programmed.samples.size() >= 5 &&
         curve.position(0.5 * (curve.u_min() + curve.u_max())).allFinite();
}

bool is_sound(const Block& block) {
  const geometry::Arc& arc = block.arc;
  const bool is_arc = block.motion == Motion::kArc;
  const bool is_nurbs = block.motion == Motion::kNurbs;
  const bool is_feed = is_arc || is_nurbs || block.motion == Motion::kLinear;
  return block.start.allFinite() && block.end.allFinite() && std::isfinite(block.feedrate) &&
         block.feedrate >= 0.0 && is_feed == (block.feedrate > 0.0) && block.tolerance >= 0.0 &&
         block.dwell >= 0.0 && block.line > 0 && is_nurbs == (block.nurbs != nullptr) &&
         (!is_nurbs || is_sound(*block.nurbs, block)) &&
         (!is_arc || (arc.centre.allFinite() && arc.e1.allFinite() && arc.e2.allFinite() &&
                      arc.radius > 0.0 && arc.sweep > 0.0 && arc.sweep < 6.2832 * 1e4));
}

/// Reads a program to its end: blocks are sound and joined, an error has a message and stays.
///
/// @param blocks_read  grows by the blocks before the end or the error
void expect_orderly(const std::string& text, std::size_t& blocks_read) {
  ReaderOptions options;
  options.most_lines = kMostLines;
  Reader reader = Reader::from_text(text, "mutant.nc", options);
  Vec3 position = Vec3::Zero();
  const std::size_t most_blocks = 4 * (text.size() + kMostLines);
  std::size_t blocks = 0;
  auto block = reader.next();
  for (; block && *block; block = reader.next()) {
    ASSERT_TRUE(is_sound(**block)) << text;
    ASSERT_EQ((*block)->start, position) << text;
    position = (*block)->end;
    if (++blocks > most_blocks && text.find_first_of("LKlk") != std::string::npos) {
      return;  // a canned cycle may be repeated 10,000 times
    }
    ASSERT_LE(blocks, most_blocks) << text;
  }
  const auto again = reader.next();
  ASSERT_EQ(block.has_value(), again.has_value()) << text;
  if (!block) {
    ASSERT_FALSE(block.error().message.empty()) << text;
    ASSERT_EQ(to_string(block.error()), to_string(again.error())) << text;
    ASSERT_TRUE((block.error().line > 0) == (block.error().column > 0)) << text;
  }
  ASSERT_LE(reader.bytes_read(), reader.size()) << text;
  blocks_read += blocks;
}

TEST(GcodeMutation, NoMutantUpsetsTheReader) {
  Random random(2009);
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < kMutants; ++i) {
    std::string text(kSeeds[random() % std::size(kSeeds)]);
    for (std::uint64_t count = 1 + random() % 6; count > 0; --count) {
      mutate(text, random);
    }
    expect_orderly(text, blocks);
    if (HasFatalFailure()) {
      return;
    }
  }
  EXPECT_GT(blocks, kMutants) << "most mutants must reach the interpreter";
}

TEST(GcodeMutation, RandomBytesAreAlwaysRefused) {
  Random random(2010);
  for (int i = 0; i < 5000; ++i) {
    std::string text(1 + random() % 2000, '\0');
    for (char& c : text) {
      c = static_cast<char>(random() % 256);
    }
    Reader reader = Reader::from_text(text, "junk.nc");
    ASSERT_FALSE(reader.next().has_value());
  }
}

}  // namespace gcode_mutation_test
}  // namespace twin::gcode
