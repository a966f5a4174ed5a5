#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "tests/support/files.hpp"

namespace twin::test {

/// A name that says that the file is not finished, or that it is below such a name; what a store is
/// working at is in its folder "work".
inline bool is_unfinished(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  if (std::find(folder.begin(), folder.end(), "work") != folder.end()) {
    return true;
  }
  return std::any_of(file.begin(), file.end(), [](const std::filesystem::path& part) {
    const std::string name = part.string();
    return name.find(".partial.") != std::string::npos || name.ends_with(".tmp") ||
           name.starts_with(".unfinished_");
  });
}

/// Whether the boxes of an MP4 file fill it exactly and its index is among them.
inline bool is_whole_mp4(const std::string& bytes) {
  bool has_index = false;
  std::size_t at = 0;
  while (at + 8 <= bytes.size()) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      size = size << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    has_index = has_index || bytes.compare(at + 4, 4, "moov") == 0;
    at += std::max<std::size_t>(size, 8);
  }
  return has_index && at == bytes.size();
}

/// Whether a CSV file ends with a line end and each of its lines has as many commas as the first;
/// commas and line ends between quotes do not count, nor do remarks before the header.
inline bool is_whole_csv(std::string_view text) {
  while (text.starts_with('#')) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  bool is_quoted = false;
  int commas = 0;
  int first = -1;
  for (const char c : text) {
    is_quoted = is_quoted != (c == '"');
    commas += c == ',' && !is_quoted ? 1 : 0;
    if (c == '\n' && !is_quoted) {
      first = first < 0 ? commas : first;
      if (commas != first) {
        return false;
      }
      commas = 0;
    }
  }
  return !is_quoted && text.ends_with('\n');
}

/// A number of eight bytes, the least first.
inline std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 8; i-- > 0;) {
    number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return number;
}

/// Whether an HDF5 file has all the bytes that its superblock promises. Source: HDF5 File Format
/// Specification, III.A: the end of file address.
inline bool is_whole_hdf5(const std::string& bytes) {
  if (bytes.size() < 48 || bytes.compare(0, 8, "\x89HDF\r\n\x1a\n") != 0) {
    return false;
  }
  return bytes.size() >= number_at(bytes, bytes[8] < 2 ? 40 : 28);
}

/// Whether the content of a file is all that its kind wants.
inline bool is_whole(const std::filesystem::path& file) {
  const std::string bytes = content(file);
  const std::string kind = file.extension().string();
  if (kind == ".json") {
    return !parse_json(bytes).is_discarded();
  }
  if (kind == ".csv") {
    return is_whole_csv(bytes);
  }
  if (kind == ".mp4") {
    return is_whole_mp4(bytes);
  }
  if (kind == ".h5") {
    return is_whole_hdf5(bytes);
  }
  const std::string end = kind == ".png"    ? "IEND\xAE\x42\x60\x82"
                          : kind == ".svg"  ? "</svg>\n\n"
                          : kind == ".html" ? "</html>\n"
                                            : "\n";
  return bytes.ends_with(end);
}

/// The files of a folder that have final names but are not whole.
inline std::vector<std::string> broken_files(const std::filesystem::path& folder) {
  std::vector<std::string> broken;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored)) {
    const auto name = std::filesystem::relative(entry.path(), folder);
    const bool is_output = name == "child.out" || name == "child.err";
    if (entry.is_regular_file() && !is_output && !is_unfinished(name) && !is_whole(entry.path())) {
      broken.push_back(name.string());
    }
  }
  return broken;
}

/// Names in a folder that say that something is not finished.
inline std::vector<std::string> unfinished_files(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored)) {
    const auto name = std::filesystem::relative(entry.path(), folder);
    if (is_unfinished(name)) {
      found.push_back(name.string());
    }
  }
  return found;
}

/// Programs that work in a folder or below it.
inline std::vector<std::string> processes_in(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    const auto place = std::filesystem::read_symlink(entry.path() / "cwd", ignored);
    if (!ignored && place.string().starts_with(folder.string())) {
      found.push_back(entry.path().filename().string() + " " + content(entry.path() / "comm"));
    }
  }
  return found;
}

}  // namespace twin::test
