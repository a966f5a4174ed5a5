#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "runtime/hand_over.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {
namespace path_threads_test {

constexpr int kBlocks = 12000;  // some of which are planned before the threads start

/// Waves, arcs, corners and dwells.
std::string program(int blocks) {
  std::string text = "G21 G90 G64\nG01 F3000\n";
  for (int i = 1; i <= blocks; ++i) {
    const double x = 0.005 * i;
    if (i % 997 == 0) {
      text += "G04 P0.01\n";
    } else if (i % 1501 == 0) {
      text += fmt::format("G03 X{:.4f} Y0 R5\nG01\n", x);
    } else {
      text +=
          fmt::format("X{:.4f} Y{:.4f}\n", x, i % 3000 < 300 ? 0.005 * (i % 2) : std::sin(x / 3.0));
    }
  }
  return text;
}

/// All that is known of a planned segment, bit for bit.
std::string bits_of(const feedrate::PlannedSegment& planned) {
  std::string text = fmt::format("{} {:a} {:a}:", planned.index, planned.segment.length,
                                 planned.segment.deviation);
  for (const feedrate::Phase& phase : planned.phases) {
    text += fmt::format(" {:a} {:a} {:a} {:a} {:a}", phase.duration, phase.s, phase.v, phase.a,
                        phase.j);
  }
  for (const feedrate::LimitZone& zone : planned.limits) {
    text += fmt::format(" {:a} {:a}", zone.begin, zone.end);
  }
  return text;
}

struct Planned {
  Expected<PlanFigures> figures;
  std::vector<std::string> segments;
  std::int64_t inspected = 0;
};

/// @param most  segments after which the sink wants no more
Planned plan(const std::string& text, PlanThreads threads, std::size_t most = 1000000) {
  auto reader = gcode::Reader::from_text(text, "text");
  Planned planned;
  planned.figures = plan_program(
      reader, {},
      [&](feedrate::PlannedSegment&& segment) {
        planned.segments.push_back(bits_of(segment));
        return planned.segments.size() < most;
      },
      [&](const gcode::Block&) {
        ++planned.inspected;
        return Expected<void>();
      },
      threads);
  return planned;
}

TEST(PathThreads, ThePlanIsTheSameBitForBit) {
  const std::string text = program(kBlocks);
  const Planned one = plan(text, PlanThreads::kOne);
  const Planned beside = plan(text, PlanThreads::kBeside);
  ASSERT_TRUE(one.figures && beside.figures);
  EXPECT_EQ(beside.segments, one.segments);
  EXPECT_EQ(beside.inspected, one.inspected);
  EXPECT_EQ(beside.figures->blocks, one.figures->blocks);
  EXPECT_EQ(beside.figures->time, one.figures->time);
  EXPECT_EQ(beside.figures->deviation, one.figures->deviation);
  EXPECT_EQ(beside.figures->short_length.mean(), one.figures->short_length.mean());
}

TEST(PathThreads, AnErrorComesAfterWhatStandsBeforeIt) {
  const std::string text = program(kBlocks) + "G01 X1e99999 Q\n" + program(10);
  const Planned one = plan(text, PlanThreads::kOne);
  const Planned beside = plan(text, PlanThreads::kBeside);
  ASSERT_FALSE(one.figures);
  ASSERT_FALSE(beside.figures);
  EXPECT_EQ(to_string(beside.figures.error()), to_string(one.figures.error()));
  EXPECT_GT(one.segments.size(), 100U);
  EXPECT_EQ(beside.segments, one.segments);
}

TEST(PathThreads, ARefusedBlockEndsThePlan) {
  auto reader = gcode::Reader::from_text(program(kBlocks), "text");
  std::int64_t blocks = 0;
  const auto figures = plan_program(
      reader, {}, [](auto&&) { return true; },
      [&](const gcode::Block&) -> Expected<void> {
        if (++blocks == 7000) {
          return fail(ErrorCode::kProgram, "too far");
        }
        return {};
      },
      PlanThreads::kBeside);
  ASSERT_FALSE(figures);
  EXPECT_EQ(figures.error().message, "too far");
  EXPECT_EQ(blocks, 7000);
}

TEST(PathThreads, EndsWhereTheSinkWantsNoMore) {
  const std::string text = program(6 * kBlocks);
  const std::size_t most = plan(program(kBlocks), PlanThreads::kOne).segments.size();
  const Planned one = plan(text, PlanThreads::kOne, most);
  const Planned beside = plan(text, PlanThreads::kBeside, most);
  ASSERT_TRUE(beside.figures);
  EXPECT_EQ(beside.segments, one.segments);
  EXPECT_LT(beside.inspected, 6 * kBlocks);
}

TEST(PathThreads, WhatTheSinkThrowsComesOut) {
  auto reader = gcode::Reader::from_text(program(kBlocks), "text");
  const std::size_t most = plan(program(kBlocks), PlanThreads::kOne).segments.size() - 10;
  std::size_t segments = 0;
  const auto throws = [&] {
    return plan_program(
        reader, {},
        [&](auto&&) -> bool {
          return ++segments < most ? true : throw std::runtime_error("no more");
        },
        {}, PlanThreads::kBeside);
  };
  EXPECT_THROW(throws(), std::runtime_error);
}

TEST(HandOver, GivesAllInOrderAndNeverRunsAheadFarther) {
  constexpr int kThings = 20000;
  HandOver<int> queue(16, 3);
  std::atomic<int> given{0};
  std::thread giver([&] {
    for (int i = 0; i < kThings; ++i) {
      given = i;
      queue.push(int(i));
    }
    queue.close();
  });
  int expected = 0;
  for (const int* thing = queue.next(); thing != nullptr; thing = queue.next()) {
    EXPECT_EQ(*thing, expected);
    EXPECT_LE(given - expected, 16 * (3 + 2));  // waiting, and both open batches
    ++expected;
  }
  giver.join();
  EXPECT_EQ(expected, kThings);
}

TEST(HandOver, AStopLetsAThreadGoThatWaitsForRoom) {
  HandOver<int> queue(1, 1);
  std::thread giver([&] {
    while (queue.push(1)) {
    }
  });
  EXPECT_NE(queue.next(), nullptr);
  queue.stop();
  giver.join();
}

}  // namespace path_threads_test
}  // namespace twin::runtime
