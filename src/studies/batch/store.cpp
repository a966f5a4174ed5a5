#include "studies/batch/store.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/sha256.hpp"

namespace twin::studies::batch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "twin-store.json";
constexpr int kLayout = 1;
constexpr std::size_t kPrefix = 2;  // digits of the key that name the folder above a result's
constexpr const char* kWork = "work";

Expected<void> make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) {
    return file_error(folder, "make this folder", code.value());
  }
  return {};
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// Removes what processes of this host that are no more have left half done: KEY.NUMBER.PID.HOST.
void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  const std::string end = "." + host_name();
  for (const auto& entry : fs::directory_iterator(folder / kWork, ignored)) {
    std::string name = entry.path().filename().string();
    if (!name.ends_with(end)) {
      continue;
    }
    name.resize(name.size() - end.size());
    const int process = std::atoi(name.substr(name.rfind('.') + 1).c_str());
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) {
      fs::remove_all(entry.path(), ignored);
    }
  }
}

/// Whether every file that job.json names is there with its checksum.
bool is_whole(const fs::path& folder, const Json& job) {
  if (!job.is_object() || !job.contains("files") || !job["files"].is_object()) {
    return false;
  }
  return std::ranges::all_of(job["files"].items(), [&](const auto& entry) {
    const auto content = read_whole_file(folder / entry.key());
    return content && entry.value() == sha256(*content);
  });
}

/// Whether the subprograms' files that a result names are still those that the program calls.
bool calls_the_same(const gcode::ProgramText& program, const std::string& summary) {
  const Json json = parse_json(summary);
  if (!json.is_object() || !json.contains("subprograms")) {
    return true;
  }
  return std::ranges::all_of(json["subprograms"], [&](const Json& called) {
    const std::string* const file = text_in(called, "file");
    const std::string* const checksum = text_in(called, "sha256");
    if (file == nullptr || checksum == nullptr) {
      return false;
    }
    const auto text = program.subprogram(fs::path(*file).stem().string());
    return text && *text && *checksum == (*text)->sha256();
  });
}

}  // namespace

Expected<Store> Store::open(fs::path folder) {
  TWIN_CHECK(make_folder(folder));
  const fs::path mark = folder / kMark;
  std::error_code code;
  if (const auto text = read_whole_file(mark)) {
    const Json json = parse_json(*text);
    if (number_in(json, "layout") != kLayout) {
      return tl::unexpected(
          Error{ErrorCode::kFile,
                fmt::format("is a store of another layout than {}; use another folder", kLayout),
                mark.string(), 0, 0});
    }
    remove_leftovers(folder);
    return Store(std::move(folder));
  }
  if (!fs::is_empty(folder, code) || code) {
    // Another process may just be making it.
    const auto is_own = [](const fs::directory_entry& entry) {
      return entry.path().filename().string().starts_with(kMark);
    };
    if (!std::ranges::all_of(fs::directory_iterator(folder, code), is_own)) {
      return tl::unexpected(Error{ErrorCode::kFile,
                                  "is no store, and not empty; name a store or a new folder",
                                  folder.string(), 0, 0});
    }
  }
  const fs::path own = folder / fmt::format("{}.{}", kMark, ::getpid());
  TWIN_CHECK(write_whole_file(own, to_text(Json{{"layout", kLayout}})));
  fs::rename(own, mark, code);
  if (code) {
    return file_error(mark, "make this file", code.value());
  }
  return Store(std::move(folder));
}

fs::path Store::folder_of(const PreparedJob& job) const {
  return folder_ / job.key.substr(0, kPrefix) / job.key;
}

bool Store::has_entry(const PreparedJob& job) const {
  std::error_code ignored;
  return fs::exists(folder_of(job), ignored);
}

std::optional<StoredResult> Store::find(const PreparedJob& job) const {
  const fs::path folder = folder_of(job);
  const auto text = read_whole_file(folder / "job.json");
  if (!text) {
    return std::nullopt;
  }
  const Json described = parse_json(*text);
  const auto summary = read_whole_file(folder / "summary.json");
  const auto failure = read_whole_file(folder / "failure.json");
  if (!is_whole(folder, described) || summary.has_value() == failure.has_value() ||
      !calls_the_same(job.program, summary.value_or(std::string()))) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return std::nullopt;
  }
  StoredResult result{summary.value_or(std::string()), {}};
  if (failure) {
    const Json json = parse_json(*failure);
    const std::string* const failed = text_in(json, "error");
    result.failure = failed != nullptr ? *failed : "unknown";
  }
  return result;
}

Expected<fs::path> Store::begin(const PreparedJob& job) const {
  static std::atomic<int> number{0};
  const fs::path work =
      folder_ / kWork / fmt::format("{}.{}.{}.{}", job.key, number++, ::getpid(), host_name());
  TWIN_CHECK(make_folder(work));
  return work;
}

Expected<void> Store::commit(const PreparedJob& job, const fs::path& work,
                             const StoredResult& result) const {
  const bool has_failed = !result.failure.empty();
  TWIN_CHECK(write_whole_file(
      work / (has_failed ? "failure.json" : "summary.json"),
      has_failed ? to_text(Json{{"error", result.failure}}) : result.summary, Durability::kCached));
  Json described;
  described["job"] = parse_json(job.canonical);
  std::error_code code;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(work, code)) {
    if (entry.is_regular_file(code)) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    TWIN_TRY(const std::string content, read_whole_file(file));
    described["files"][file.filename().string()] = sha256(content);
  }
  TWIN_CHECK(write_whole_file(work / "job.json", to_text(described), Durability::kCached));
  const fs::path target = folder_of(job);
  TWIN_CHECK(make_folder(target.parent_path()));
  fs::rename(work, target, code);
  if (code && fs::exists(target / "job.json")) {  // another process was quicker, with equal bytes
    fs::remove_all(work, code);
    return {};
  }
  if (code) {
    return file_error(target, "make this folder", code.value());
  }
  return {};
}

}  // namespace twin::studies::batch
