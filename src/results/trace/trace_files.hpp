#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

/// Names of the files that hold a trace in the folder of a run.
namespace twin::results {

/// As which files a trace is written.
enum class TraceFiles {
  kCsv,   ///< trace.csv
  kHdf5,  ///< trace.h5
  kBoth,  ///< both of them
  kNone,  ///< no file
};

/// Their names on the command line and in job files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 4> kTraceFilesNames{"csv", "hdf5", "both", "none"};

/// The files of a name, or nothing where it is no such name.
std::optional<TraceFiles> trace_files_of(std::string_view name) noexcept;

constexpr bool has_csv(TraceFiles files) {
  return files == TraceFiles::kCsv || files == TraceFiles::kBoth;
}
constexpr bool has_hdf5(TraceFiles files) {
  return files == TraceFiles::kHdf5 || files == TraceFiles::kBoth;
}

inline constexpr std::string_view kTraceName = "trace.csv";
inline constexpr std::string_view kPartialTraceName = "trace.partial.csv";
inline constexpr std::string_view kHdf5TraceName = "trace.h5";
inline constexpr std::string_view kPartialHdf5TraceName = "trace.partial.h5";

/// Whether a trace of this name is of a run that is under way or ended early.
constexpr bool is_partial_trace(std::string_view name) {
  return name == kPartialTraceName || name == kPartialHdf5TraceName;
}

/// The trace in a folder: of the files of the four names the newest. Where two were written at the
/// same time, a whole one comes before a partial one and CSV before HDF5. Where there is none, the
/// name that a trace would have.
std::filesystem::path find_trace(const std::filesystem::path& folder);

}  // namespace twin::results
