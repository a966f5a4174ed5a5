#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "tests/fuzz/chain/chain_case.hpp"

namespace twin::fuzz {

/// How a motion came to its end.
enum class Ending : std::uint8_t {
  kWhole,    ///< the program was followed to its end
  kStopped,  ///< at rest in a hold that does not end
  kRefused,  ///< the reader or the planner gave an error
  kNone,     ///< the motion went on beyond what its length and its limits can need
};

/// The set points of a case, from runtime::SetPoints.
struct Trajectory {
  std::vector<Vec3> points;         ///< one a period [mm]
  std::vector<std::int64_t> lines;  ///< NC line of each
  Ending ending = Ending::kNone;
  std::string error;  ///< of kRefused
};

/// Follows a case to its end, or until it has taken several times as long as a motion that stops
/// after each block, at the lowest override, with all holds.
Trajectory follow(const Case& made);

}  // namespace twin::fuzz
