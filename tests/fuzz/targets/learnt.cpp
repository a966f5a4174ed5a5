#include <cmath>

#include "runtime/correction_file.hpp"
#include "studies/compensate/learning.hpp"
#include "studies/identify/search_checkpoint.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/target.hpp"

// What studies leave for later runs: corrections, what was learnt, checkpoints of searches.
namespace twin::fuzz {
namespace learnt_target {

constexpr double kLargestOffset = 0.05;  // [mm]
constexpr std::size_t kPeriods = 3;      // of the seeds

void read_correction(const MemoryFile& file) {
  const runtime::CorrectionOrigin origin{.program = "a.nc",
                                         .program_sha256 = "0",
                                         .machine = "a.toml",
                                         .machine_sha256 = "0",
                                         .period = 0.001,
                                         .feedrate = {}};
  const auto correction = runtime::read_correction(file.path(), origin, kLargestOffset);
  if (!correction) {
    promise(!correction.error().message.empty(), "an error of a correction without a message");
    return;
  }
  for (const auto& offset : correction->offsets) {
    promise(offset.norm() <= 2.0 * kLargestOffset, "an offset beyond the limit");
  }
}

void read_learnt(const MemoryFile& file) {
  const auto learnt = studies::compensate::read_learnt(file.path(), kPeriods);
  if (!learnt) {
    promise(!learnt.error().message.empty(), "an error of what was learnt without a message");
    return;
  }
  for (const auto& mismatch : learnt->mismatch) {
    promise(mismatch.allFinite(), "a mismatch that is not finite");
  }
}

void read_checkpoint(const MemoryFile& file) {
  const auto checkpoint = studies::identify::read_checkpoint(file.path(), "fit");
  promise(checkpoint || !checkpoint.error().message.empty(),
          "an error of a checkpoint without a message");
}

void run(Bytes bytes) {
  const MemoryFile file(bytes);
  read_correction(file);
  read_learnt(file);
  read_checkpoint(file);
}

}  // namespace learnt_target

const Target kLearnt{"learnt", learnt_target::run};

}  // namespace twin::fuzz
