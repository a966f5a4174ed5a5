#include "results/trace/trace_files.hpp"

#include <algorithm>
#include <system_error>

namespace twin::results {

std::optional<TraceFiles> trace_files_of(std::string_view name) noexcept {
  const auto found = std::ranges::find(kTraceFilesNames, name);
  return found == kTraceFilesNames.end()
             ? std::nullopt
             : std::optional(static_cast<TraceFiles>(found - kTraceFilesNames.begin()));
}

std::filesystem::path find_trace(const std::filesystem::path& folder) {
  std::filesystem::path found = folder / kTraceName;
  std::optional<std::filesystem::file_time_type> newest;
  for (const std::string_view name :
       {kTraceName, kHdf5TraceName, kPartialTraceName, kPartialHdf5TraceName}) {
    std::error_code none;
    const auto time = std::filesystem::last_write_time(folder / name, none);
    if (!none && (!newest || time > *newest)) {
      newest = time;
      found = folder / name;
    }
  }
  return found;
}

}  // namespace twin::results
