#include "runtime/shared_blocks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <thread>

namespace twin::runtime {
namespace shared_blocks_test {

constexpr int kBlocks = 1000;

std::string program() {
  std::string text = "F600\n";
  for (int i = 1; i <= kBlocks; ++i) {
    text += fmt::format("G01 X{}\n", 0.1 * i);
  }
  return text;
}

/// Lines of the blocks that a source gives, up to a number of them.
std::vector<std::int64_t> lines_of(const BlockSource& source, int most) {
  std::vector<std::int64_t> lines;
  for (int i = 0; i < most; ++i) {
    const auto block = source();
    EXPECT_TRUE(block);
    if (!block || !*block) {
      break;
    }
    lines.push_back((*block)->line);
  }
  return lines;
}

TEST(SharedBlocks, BothGetEveryBlockInItsOrderWhoeverIsAhead) {
  SharedBlocks blocks(gcode::Reader::from_text(program(), "text"));
  const BlockSource first = blocks.first();
  const BlockSource second = blocks.second();
  std::vector<std::int64_t> of_first;
  std::vector<std::int64_t> of_second;
  for (const int turn : {1, 300, 2, 700, 5000}) {
    for (const std::int64_t line : lines_of(first, turn)) {
      of_first.push_back(line);
    }
    for (const std::int64_t line : lines_of(second, 1001 - turn % 1000)) {
      of_second.push_back(line);
    }
  }
  ASSERT_EQ(of_first.size(), static_cast<std::size_t>(kBlocks));
  for (int i = 0; i < kBlocks; ++i) {
    EXPECT_EQ(of_first[static_cast<std::size_t>(i)], i + 2);
  }
  EXPECT_EQ(of_first, of_second);
}

TEST(SharedBlocks, KeepsNoMoreThanWhatLiesBetweenTheTwo) {
  SharedBlocks blocks(gcode::Reader::from_text(program(), "text"));
  const BlockSource first = blocks.first();
  const BlockSource second = blocks.second();
  std::size_t most = 0;
  for (int i = 0; i < kBlocks; ++i) {
    ASSERT_TRUE(first() && second());
    most = std::max(most, blocks.stored());
  }
  EXPECT_LE(most, 64U);
  EXPECT_EQ(blocks.stored(), 0U);
}

TEST(SharedBlocks, AnErrorComesToBothAfterTheBlocksBeforeIt) {
  SharedBlocks blocks(gcode::Reader::from_text("G01 X1 F600\nX2\nQ3\n", "text"));
  for (const BlockSource& source : {blocks.first(), blocks.second()}) {
    EXPECT_EQ(lines_of(source, 2).size(), 2U);
    const auto wrong = source();
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().line, 3);
    EXPECT_FALSE(source());
  }
}

TEST(SharedBlocks, TwoThreadsGetTheSame) {
  SharedBlocks blocks(gcode::Reader::from_text(program(), "text"));
  std::vector<std::int64_t> of_first;
  std::vector<std::int64_t> of_second;
  {
    const std::jthread thread([&] { of_first = lines_of(blocks.first(), 2 * kBlocks); });
    of_second = lines_of(blocks.second(), 2 * kBlocks);
  }
  EXPECT_EQ(of_first.size(), static_cast<std::size_t>(kBlocks));
  EXPECT_EQ(of_first, of_second);
}

}  // namespace shared_blocks_test
}  // namespace twin::runtime
