#include "session/results.hpp"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/atomic_file.hpp"
#include "results/metrics/summary.hpp"

namespace twin::session {

Expected<void> prepare_output_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), error);
  }
  if (error) {
    return file_error(file.parent_path(), "make this folder", error.value());
  }
  const auto existing = std::filesystem::status(file, error);
  if (std::filesystem::exists(existing) && !std::filesystem::is_regular_file(existing)) {
    return tl::unexpected(Error{
        ErrorCode::kFile, "there is something else than a file of this name", file.string(), 0, 0});
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) != 0) {
    return file_error(folder, "write into this folder", errno);
  }
  return {};
}

std::filesystem::path result_folder(const std::filesystem::path& chosen,
                                    const std::filesystem::path& name) {
  const bool is_way_out = name == "." || name == "..";  // the stem of "...nc" is ".."
  return chosen.empty() ? std::filesystem::path("renders") / (is_way_out ? "program" : name)
                        : chosen;
}

Expected<void> write_summary(const std::filesystem::path& folder,
                             const runtime::RunResult& result) {
  return write_whole_file(folder / (result.failure ? "summary.partial.json" : "summary.json"),
                          results::to_json(result.summary));
}

void remove_stale_results(const std::filesystem::path& folder, Results how,
                          results::TraceFiles trace) {
  using namespace results;
  std::vector<std::string_view> names{"video.mp4", "report.html", kShadowName};
  const bool is_whole = how == Results::kWhole;
  names.emplace_back(is_whole ? "summary.partial.json" : "summary.json");
  const auto add_unless = [&names](bool is_written, std::string_view name) {
    if (!is_written) {
      names.push_back(name);
    }
  };
  add_unless(is_whole && has_csv(trace), kTraceName);
  add_unless(is_whole && has_hdf5(trace), kHdf5TraceName);
  add_unless(!is_whole && has_csv(trace), kPartialTraceName);
  add_unless(!is_whole && has_hdf5(trace), kPartialHdf5TraceName);
  std::error_code ignored;
  for (const std::string_view name : names) {
    std::filesystem::remove(folder / name, ignored);
  }
  if (is_whole && trace != TraceFiles::kNone) {
    return;
  }
  for (const auto& plot : std::filesystem::directory_iterator(folder / "plots", ignored)) {
    const std::string name = plot.path().filename().string();
    if (plot.is_regular_file(ignored) && name.find(".partial.") == std::string::npos) {
      std::filesystem::remove(plot.path(), ignored);
    }
  }
}

}  // namespace twin::session
