#pragma once

#include <cstdint>

#include "core/vec.hpp"

namespace twin::results {

/// What the cycle records in one interpolation period; plain data, copied through a ring buffer.
struct Sample {
  double t = 0.0;                ///< time since the first set point [s]
  std::int64_t segment = 0;      ///< planned segment, counted from 0
  std::int64_t block = 0;        ///< NC block the set point is on, counted from 0 over all blocks
  std::int64_t line = 0;         ///< NC line of that block
  Vec3 command = Vec3::Zero();   ///< set point [mm]
  double feedrate = 0.0;         ///< feedrate of the set point [mm/s]
  double feedrate_limit = 0.0;   ///< limit in force at the set point [mm/s]
  Vec2 encoder = Vec2::Zero();   ///< what the encoder counts mean [mm]
  Vec2 table = Vec2::Zero();     ///< true position of the table, the encoder's if unknown [mm]
  Vec2 volts = Vec2::Zero();     ///< drive command [V]
  Vec2 torque = Vec2::Zero();    ///< of the motors, 0 if unknown [N.m]
  Vec2 friction = Vec2::Zero();  ///< of the slides against positive motion, 0 if unknown [N]
  double cycle_time = 0.0;       ///< wall-clock time of the cycle's computation [s]
  double wake_up_latency = 0.0;  ///< on the wall clock: begin of the period after its deadline [s]
  double total_time = 0.0;       ///< on the wall clock: from the deadline to the written output [s]
  bool is_passed_over = false;   ///< its period never began: measured values are interpolated
};

}  // namespace twin::results
