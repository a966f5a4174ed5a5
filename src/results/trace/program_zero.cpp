#include "results/trace/program_zero.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "core/json.hpp"
#include "results/trace/trace_files.hpp"

namespace twin::results {

void ProgramZero::add(double t, double height) {
  const double before = changes_.empty() ? 0.0 : changes_.back().height;
  if (height != before && changes_.size() < kMostChanges) {
    changes_.push_back({t, height});
  }
}

double ProgramZero::at(double t) const noexcept {
  const auto next = std::upper_bound(changes_.begin(), changes_.end(), t,
                                     [](double time, const Change& c) { return time < c.t; });
  return next == changes_.begin() ? 0.0 : std::prev(next)->height;
}

ProgramZero ProgramZero::beside(const std::filesystem::path& trace) {
  const char* const name =
      is_partial_trace(trace.filename().string()) ? "summary.partial.json" : "summary.json";
  std::ifstream in(trace.parent_path() / name);
  return of_summary(
      std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()));
}

ProgramZero ProgramZero::of_summary(std::string_view text) {
  ProgramZero zero;
  const Json json = parse_json(text);
  const auto list = json.is_object() ? json.find("program_zero_mm") : json.end();
  if (!json.is_object() || list == json.end() || !list->is_array()) {
    return zero;
  }
  for (const Json& change : *list) {
    if (change.is_array() && change.size() == 2 && change[0].is_number() && change[1].is_number()) {
      zero.add(change[0].get<double>(), change[1].get<double>());
    }
  }
  return zero;
}

}  // namespace twin::results
