#include "results/trace/csv_reader.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/atomic_file.hpp"

namespace twin::results {
namespace {

constexpr std::size_t kBlockBytes = 128UL * 1024;  // and the longest line

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
    text.remove_prefix(1);
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

/// Text for a message: not too long, and without control characters.
std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return result;
}

}  // namespace

Expected<CsvReader> CsvReader::open(const std::filesystem::path& file) {
  CsvReader reader;
  reader.name_ = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return file_error(file, "read", EISDIR);
  }
  reader.file_.reset(std::fopen(file.c_str(), "rbe"));
  if (!reader.file_) {
    return file_error(file, "open", errno);
  }
  reader.block_.resize(kBlockBytes);
  std::string_view line;
  auto got = reader.read_line(line);
  if (!got) {
    return tl::unexpected(std::move(got.error()));
  }
  if (line.substr(0, 3) == "\xEF\xBB\xBF") {
    line.remove_prefix(3);
  }
  if (!*got || trimmed(line).empty()) {
    reader.line_ = 1;
    return reader.complaint("a header line with the names of the columns is missing");
  }
  const auto no_text = std::ranges::find_if(
      line, [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r'; });
  if (no_text != line.end()) {
    reader.line_ = 1;
    return reader.complaint(fmt::format(
        "byte 0x{:02X} is no text; expected a header line with the names of the columns",
        static_cast<unsigned char>(*no_text)));
  }
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    reader.header_.emplace_back(trimmed(line.substr(begin, end - begin)));
    reader.slot_.push_back(static_cast<int>(reader.slot_.size()));
    begin = end + 1;
  }
  reader.chosen_ = reader.header_.size();
  reader.last_field_ = reader.header_.size() - 1;
  return reader;
}

bool CsvReader::has(std::string_view column) const noexcept {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

Expected<void> CsvReader::select(std::span<const std::string_view> columns) {
  std::fill(slot_.begin(), slot_.end(), -1);
  last_field_ = 0;
  chosen_ = columns.size();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto found = std::find(header_.begin(), header_.end(), columns[i]);
    if (found == header_.end()) {
      std::string known;
      for (const std::string& name : header_) {
        known.append(known.empty() ? "" : ",").append(shown(name));
      }
      return tl::unexpected<Error>(
          Error{ErrorCode::kFile,
                fmt::format("no column {}; there are: {}", columns[i], known.substr(0, 400)), name_,
                1, 0});
    }
    const auto field = static_cast<std::size_t>(found - header_.begin());
    assert(slot_[field] < 0);  // a column is chosen once
    slot_[field] = static_cast<int>(i);
    last_field_ = std::max(last_field_, field);
  }
  return {};
}

Expected<bool> CsvReader::next(std::span<double> values) {
  assert(values.size() == chosen_);
  std::string_view line;
  auto got = read_line(line);
  if (!got || !*got) {
    return got;
  }
  if (trimmed(line).empty()) {
    const int blank = line_;
    while (got && *got && trimmed(line).empty()) {
      got = read_line(line);
    }
    if (got && *got) {
      line_ = blank;
      return complaint("a blank line between rows");
    }
    return got;
  }
  return parse(line, values).map([] { return true; });
}

Expected<void> CsvReader::parse(std::string_view line, std::span<double> values) const {
  std::size_t begin = 0;
  for (std::size_t field = 0; field <= last_field_; ++field) {
    if (begin > line.size()) {
      return complaint(fmt::format("the row ends after {} of {} columns", field, header_.size()),
                       line.size() + 1);
    }
    const void* comma =
        begin < line.size() ? std::memchr(line.data() + begin, ',', line.size() - begin) : nullptr;
    const std::size_t end =
        comma != nullptr ? static_cast<std::size_t>(static_cast<const char*>(comma) - line.data())
                         : line.size();
    if (const int slot = slot_[field]; slot >= 0) {
      const std::string_view text = trimmed(line.substr(begin, end - begin));
      double& value = values[static_cast<std::size_t>(slot)];
      const auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size() ||
          !std::isfinite(value)) {
        return complaint(
            fmt::format("'{}' in column {} is not a finite number", shown(text), header_[field]),
            begin + 1);
      }
    }
    begin = end + 1;
  }
  return {};
}

/// The next line without its line end; false at the end of the file. The view holds until the next
/// call.
Expected<bool> CsvReader::read_line(std::string_view& line) {
  for (;;) {
    const char* const from = block_.data() + begin_;
    const std::size_t size = end_ - begin_;
    const void* const feed = size > 0 ? std::memchr(from, '\n', size) : nullptr;
    const bool is_last = feed == nullptr && size > 0 && std::feof(file_.get()) != 0;
    if (feed != nullptr || is_last) {
      const std::size_t length =
          is_last ? size : static_cast<std::size_t>(static_cast<const char*>(feed) - from);
      line = std::string_view(from, length);
      begin_ += length + (is_last ? 0 : 1);
      ++line_;
      return true;
    }
    if (std::feof(file_.get()) != 0) {
      return false;
    }
    if (size == block_.size()) {
      ++line_;
      return complaint(fmt::format("a line longer than {} bytes; this is no trace", size));
    }
    std::memmove(block_.data(), from, size);
    begin_ = 0;
    end_ = size + std::fread(block_.data() + size, 1, block_.size() - size, file_.get());
    if (std::ferror(file_.get()) != 0) {
      return file_error(name_, "read", errno);
    }
  }
}

tl::unexpected<Error> CsvReader::complaint(std::string message, std::size_t column) const {
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, std::move(message), name_, line_, static_cast<int>(column)});
}

}  // namespace twin::results
