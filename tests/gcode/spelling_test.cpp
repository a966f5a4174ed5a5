#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "program.hpp"

namespace twin::gcode {
namespace spelling_test {

using Random = std::mt19937_64;

/// A word as canonical text, such as "X-1.25"; a line is a list of them, in any order.
using Words = std::vector<std::string>;

double pick(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

std::string word(char letter, double value) { return fmt::format("{}{:.4f}", letter, value); }

/// A line that is sound whatever came before it.
Words random_line(Random& random) {
  const Words place = {word('X', pick(random, -99, 99)), word('Y', pick(random, -99, 99))};
  const std::string feed = word('F', pick(random, 1, 9999));
  switch (random() % 8) {
    case 0:
      return {"G0", place[0], word('Z', pick(random, -9, 9))};
    case 1:
      return {
          "G2", "G17", "G91", feed, word('I', pick(random, 1, 9)), word('J', pick(random, 1, 9))};
    case 2:
      return {"G3", "G90", "G21", "G17", feed, place[0], place[1], "R500"};
    case 3:
      return {"G4", word('P', pick(random, 0, 2))};
    case 4:
      return {random() % 2 == 0 ? "G61.1" : "G61", "M8", "S1200"};
    case 5:
      return {"G64", word('P', pick(random, 0, 0.1)), "T3"};
    default:
      return {"G1", random() % 2 == 0 ? "G90" : "G91", place[0], place[1], feed};
  }
}

/// The same number with other digits: a sign, leading and trailing zeros, no zero before the point.
std::string respell_number(const std::string& number, Random& random) {
  const bool is_negative = number[0] == '-';
  std::string digits = is_negative ? number.substr(1) : number;
  const bool has_point = digits.find('.') != std::string::npos;
  if (random() % 3 == 0) {
    digits = "0" + digits;
  } else if (has_point && digits.starts_with("0.") && random() % 2 == 0) {
    digits = digits.substr(1);
  }
  if (random() % 3 == 0) {
    digits += has_point ? "00" : ".0";
  }
  const char* const plus = random() % 4 == 0 ? "+" : "";
  return (is_negative ? "-" : plus) + digits;
}

/// The same words with other letters' case, numbers, blanks, order and comments.
std::string respell(Words words, int number, const char* line_end, Random& random) {
  std::shuffle(words.begin(), words.end(), random);
  std::string text = random() % 2 == 0 ? fmt::format("N{} ", number) : "";
  for (const std::string& w : words) {
    text += random() % 2 == 0 ? w[0] : static_cast<char>(w[0] - 'A' + 'a');
    text += random() % 4 == 0 ? " " : "";
    text += respell_number(w.substr(1), random);
    text += random() % 2 == 0 ? "" : random() % 5 == 0 ? "(X9 ; no word)" : " \t";
  }
  text += random() % 6 == 0 ? "; G99 (no word" : "";
  return text + line_end;
}

TEST(Spelling, OfAProgramDoesNotChangeItsBlocks) {
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    std::string plain;
    std::string other = random() % 2 == 0 ? "\xEF\xBB\xBF" : "";
    const char* const ends[] = {"\n", "\r\n", "\r"};
    const char* const line_end = ends[random() % 3];
    for (int line = 0; line < 30; ++line) {
      const Words words = random_line(random);
      for (const std::string& w : words) {
        plain += w + " ";
      }
      plain += "\n";
      other += respell(words, 10 * line, line_end, random);
    }
    ASSERT_EQ(to_text(blocks_of(other)), to_text(blocks_of(plain))) << plain << "\n" << other;
  }
}

TEST(Spelling, ModalWordsMayBeLeftOut) {
  Random random(6);
  std::string full = "G1 G90 X1 F100\n";
  std::string terse = full;
  const char* motion = "G1";
  for (int line = 0; line < 5000; ++line) {
    const char* const next = random() % 2 == 0 ? "G0" : "G1";
    const std::string place =
        word('X', pick(random, -99, 99)) + word('Y', pick(random, -99, 99)) + "\n";
    full += std::string(next) + "F100" + place;
    terse += (next == std::string(motion) ? "" : next) + place;
    motion = next;
  }
  EXPECT_EQ(to_text(blocks_of(terse)), to_text(blocks_of(full)));
}

TEST(Spelling, IncrementalPlacesEqualAbsoluteOnes) {
  Random random(7);
  std::string absolute = "G1 G90 F100\n";
  std::string incremental = "G1 G91 F100\n";
  long x = 0;  // [0.25 mm], which is exact in binary
  for (int line = 0; line < 2000; ++line) {
    const long step = static_cast<long>(random() % 2000) - 1000;
    x += step;
    absolute += fmt::format("X{:.2f}\n", 0.25 * static_cast<double>(x));
    incremental += fmt::format("X{:.2f}\n", 0.25 * static_cast<double>(step));
  }
  EXPECT_EQ(to_text(blocks_of(incremental)), to_text(blocks_of(absolute)));
}

}  // namespace spelling_test
}  // namespace twin::gcode
