#include "studies/identify/keys.hpp"

#include <algorithm>

#include "config/nearest_name.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {
namespace {

/// Keys of everything that a fit can change.
std::vector<std::string> known_keys(const config::MachineFile& machine) {
  std::vector<std::string> known;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    for (const Candidate& candidate : axis_candidates(machine, axis)) {
      known.push_back(candidate.parameter.key);
    }
    const std::string name = axis == hal::kX ? "x" : "y";
    known.push_back("servo." + name + ".kd");
    known.push_back("servo." + name + ".trim_V");
    known.push_back("table." + name + ".encoder_um_per_count");
  }
  return known;
}

}  // namespace

Expected<std::vector<std::string>> full_keys(const std::vector<std::string>& names,
                                             const config::MachineFile& machine) {
  const std::vector<std::string> known = known_keys(machine);
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    const auto found = std::ranges::find_if(
        known, [&](const std::string& key) { return key == name || key.starts_with(name + "_"); });
    if (found == known.end()) {
      return fail(ErrorCode::kUsage, "--fix, --free: " + name +
                                         " is nothing that a trace is fitted for" +
                                         config::did_you_mean(name, known));
    }
    keys.push_back(*found);
  }
  return keys;
}

}  // namespace twin::studies::identify
