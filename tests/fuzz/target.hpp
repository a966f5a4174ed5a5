#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// What reads bytes that somebody else wrote, each as a function of bytes: for libFuzzer
/// (fuzzer_main.cpp), for the corpus of findings and for random programs (twin_fuzz.cpp).
namespace twin::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A promise that does not hold for the bytes at hand.
class Finding : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws a Finding with this message unless a promise holds.
inline void promise(bool holds, const char* message) {
  if (!holds) {
    throw Finding(message);
  }
}
inline void promise(bool holds, const std::string& message) {
  if (!holds) {
    throw Finding(message);
  }
}

/// The bytes as text.
inline std::string_view text_of(Bytes bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// One thing that is fuzzed.
struct Target {
  std::string_view name;
  void (*run)(Bytes);                    ///< throws a Finding where a promise does not hold
  std::string (*show)(Bytes) = nullptr;  ///< what the bytes mean to a reader; null: themselves
};

extern const Target kReader;       ///< an NC program as text
extern const Target kMachineFile;  ///< a machine file, and lines of `--set`
extern const Target kCsv;          ///< a trace or a recording
extern const Target kOperator;     ///< lines of the control socket, keys, override schedules
extern const Target kJson;         ///< summary.json of a folder of results
extern const Target kTools;        ///< a tool table
extern const Target kJobs;         ///< a job file, a sweep, what twin identify has found
extern const Target kStore;        ///< records of a store of results
extern const Target kLearnt;       ///< a correction, what runs have taught, a search's checkpoint
extern const Target kHdf5;         ///< a trace as HDF5
extern const Target kSegment;      ///< the shared memory of `twin plant`
extern const Target kChain;        ///< settings, program, overrides and holds to set points

}  // namespace twin::fuzz
