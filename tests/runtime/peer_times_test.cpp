#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "config/machine_file.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::runtime {
namespace peer_times_test {

/// A program, and the time that LinuxCNC 2.9 needs for it: 2,450 mm/s^2 for each axis, no limit of
/// jerk, G64 P0.01, blocks not merged. LinuxCNC leaves that tolerance by 3 to 8 %.
struct Peer {
  const char* folder;
  const char* name;
  double time;  ///< [s]
};

constexpr Peer kPeers[] = {
    {"nc_programs", "dolphin", 9.169},    {"nc_programs", "oxalis", 6.280},
    {"nc_programs", "square", 8.316},     {"nc_programs", "star", 8.226},
    {"nc_programs", "gear", 7.571},       {"nc_programs", "zigzag", 11.711},
    {"nc_programs", "butterfly", 10.926}, {"../shared/peers", "leaf", 5.310},
    {"../shared/peers", "fish", 8.095},
};

config::MachineFile with_the_peers_limits() {
  config::MachineFile machine;
  machine.limits.acceleration = 1e5;  // of the path: the axes limit it
  machine.limits.jerk = 1e9;
  machine.limits.axis_acceleration = {2450.0, 2450.0, 0.0};
  machine.planning.circular_error = 10.0;  // no servo model
  return machine;
}

TEST(BesideLinuxCnc, EveryProgramIsQuickerWithinTheTolerance) {
  const config::MachineFile machine = with_the_peers_limits();
  for (const Peer& peer : kPeers) {
    const auto file =
        std::filesystem::path(TWIN_SOURCE_DIR) / peer.folder / (std::string(peer.name) + ".nc");
    if (!std::filesystem::exists(file)) {
      continue;  // leaf and fish are not part of the project
    }
    auto reader = gcode::Reader::open(file.string());
    ASSERT_TRUE(reader.has_value()) << peer.name;
    const auto figures =
        plan_program(*reader, machine, [](feedrate::PlannedSegment&&) { return true; });
    ASSERT_TRUE(figures.has_value()) << peer.name;
    EXPECT_LT(figures->time, peer.time) << peer.name;
    EXPECT_LE(figures->deviation, 0.01) << peer.name;
    EXPECT_EQ(figures->fallbacks, 0) << peer.name;
    std::printf("%-9s %7.3f s, LinuxCNC %7.3f s: %.4f\n", peer.name, figures->time, peer.time,
                figures->time / peer.time);
  }
}

}  // namespace peer_times_test
}  // namespace twin::runtime
