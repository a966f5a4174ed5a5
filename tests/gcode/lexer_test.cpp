#include "gcode/words/lexer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "gcode/values/number.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {
namespace lexer_test {

/// The words of a line as "letter value @column", or the fault as "column: message".
std::string words_of(std::string_view line) {
  Parameters parameters(nullptr, Dialect::kLinuxCnc);
  Lexer lexer(line, parameters);
  std::string text;
  Word word;
  for (Lexer::Found found = lexer.next(word); found == Lexer::Found::kWord;
       found = lexer.next(word)) {
    text += fmt::format("{}{}@{} ", word.letter, word.value, word.column);
  }
  const Error fault = lexer.take_fault();
  return fault.message.empty() ? text : fmt::format("{}: {}", fault.column, fault.message);
}

TEST(Lexer, WordsWithAndWithoutBlanksInBothCases) {
  EXPECT_EQ(words_of("G1X1Y-2.5"), "G1@1 X1@3 Y-2.5@5 ");
  EXPECT_EQ(words_of(" g01\tx 1.0  y +2 "), "G1@2 X1@6 Y2@13 ");
  EXPECT_EQ(words_of(""), "");
}

TEST(Lexer, CommentsPassByWhereverAWordMayBegin) {
  EXPECT_EQ(words_of("(a;b)G0(c)X1;d(e"), "G0@6 X1@11 ");
  EXPECT_EQ(words_of("(\xC3\xA4 and\ttab)X1"), "X1@13 ");
}

TEST(Lexer, CommentFaultsPointAtTheComment) {
  EXPECT_EQ(words_of("X1 (open (one) Y2"),
            "4: the comment has more ( than ), and text behind it: expected as many");
  EXPECT_EQ(words_of("X1 (a\x01)"), "6: byte 0x01 is not NC text: is this an NC program?");
  EXPECT_EQ(words_of("X1)"), "3: unexpected ')': expected a letter and a number");
}

TEST(Lexer, LetterWithoutNumberSaysWhatStandsThere) {
  EXPECT_EQ(words_of("X"), "1: X has no number: expected one before the end of the line");
  EXPECT_EQ(words_of("G1 XY2"), "4: X has no number: expected one, found 'Y2'");
  EXPECT_EQ(words_of("Xnan"), "1: X has no number: expected one, found 'nan'");
  EXPECT_EQ(words_of("X-inf"), "1: X has no number: expected one, found '-inf'");
  EXPECT_EQ(words_of("X(one)1"), "1: X has no number: expected one, found '(one)1'");
}

TEST(Lexer, NumbersHaveNoExponentAndNoEndlessSize) {
  EXPECT_EQ(words_of("X1e9"),
            "3: X has a number with an exponent: expected a plain decimal number such as X0.001");
  EXPECT_EQ(words_of("G1 X" + std::string(400, '9')),
            "4: the number of X is too large: expected at most 1000000000");
}

TEST(Lexer, BlanksDoNotSplitNumbers) {
  EXPECT_EQ(words_of("X1 2"), "4: unexpected '2': expected a letter and a number");
  EXPECT_EQ(words_of("X- 2"), "X-2@1 ");
  EXPECT_EQ(words_of("X- - 2"), "1: X has no number: expected one, found '-'");
}

TEST(Lexer, ExpressionsGiveWordsTheirNumbers) {
  EXPECT_EQ(words_of("#1=2 G1"), "G1@6 ");
  EXPECT_EQ(words_of("X[1+2]Y-[3]Z- sin[90] i+#5"), "X3@1 Y-3@7 Z-1@12 I0@23 ");
  EXPECT_EQ(words_of("X[1e3]"), "4: expected an operator or ], found 'e3]'");
  EXPECT_EQ(words_of("X[1e9*2]"), "4: expected an operator or ], found 'e9*2]'");
  EXPECT_EQ(words_of("X[1000000*2000]"),
            "1: the number of X is too large: expected at most 1000000000");
}

TEST(Lexer, LineNumbersOfAnySize) {
  EXPECT_EQ(words_of("N99999999999999999999 G1"), "N0@1 G1@23 ");
  EXPECT_EQ(words_of("N12.5 G1"), "N12@1 G1@7 ");
}

TEST(Lexer, BytesThatAreNoTextAreGivenByValue) {
  EXPECT_EQ(words_of(std::string_view("G1\0X", 4)),
            "3: byte 0x00 is not NC text: is this an NC program?");
  EXPECT_EQ(words_of("\x7F"
                     "ELF"),
            "1: byte 0x7F is not NC text: is this an NC program?");
  EXPECT_EQ(words_of("X\xFF"), "2: byte 0xFF is not NC text: is this an NC program?");
  EXPECT_EQ(words_of("(\x01)"), "2: byte 0x01 is not NC text: is this an NC program?");
}

}  // namespace lexer_test

namespace number_test {

void expect_number(const std::string& text, double value, std::size_t length) {
  const Number number = parse_number(text);
  EXPECT_EQ(number.status, NumberStatus::kOk) << text;
  EXPECT_EQ(number.value, value) << text;
  EXPECT_EQ(number.length, length) << text;
}

TEST(Number, SignPointAndDigitsInEveryArrangement) {
  expect_number("12", 12.0, 2);
  expect_number("-12.5", -12.5, 5);
  expect_number("+.5", 0.5, 3);
  expect_number("7.", 7.0, 2);
  expect_number("0007", 7.0, 4);
}

TEST(Number, EndsWhereTheDigitsEnd) {
  expect_number("12Y3", 12.0, 2);
  expect_number("1.2.3", 1.2, 3);
  expect_number("1-2", 1.0, 1);
  expect_number("1e3", 1.0, 1);
}

TEST(Number, WhatIsNoNumberIsMissing) {
  for (const char* text : {"", "-", "+", ".", "-.", "--1", "nan", "inf", "-inf", "x", " 1"}) {
    EXPECT_EQ(parse_number(text).status, NumberStatus::kMissing) << text;
  }
}

TEST(Number, TooLargeIsToldFromMissing) {
  EXPECT_EQ(parse_number("1000000000").status, NumberStatus::kOk);
  EXPECT_EQ(parse_number("1000000000.1").status, NumberStatus::kTooLarge);
  EXPECT_EQ(parse_number("-99999999999").status, NumberStatus::kTooLarge);
  EXPECT_EQ(parse_number(std::string(500, '9')).status, NumberStatus::kTooLarge);
}

TEST(Number, IsTheNearestDoubleOfTheCLibrary) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::string text = fmt::format("{}{}.{}", random() % 2 == 0 ? "-" : "",
                                         random() % 1000000000, random() % 1000000000000000ULL);
    const Number number = parse_number(text);
    ASSERT_EQ(number.value, std::strtod(text.c_str(), nullptr)) << text;
    ASSERT_EQ(number.length, text.size());
  }
}

}  // namespace number_test
}  // namespace twin::gcode
