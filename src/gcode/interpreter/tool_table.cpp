#include "gcode/interpreter/tool_table.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "gcode/text/fault.hpp"
#include "gcode/values/number.hpp"

namespace twin::gcode {
namespace {

constexpr std::string_view kTableBlanks = " \t\r";
constexpr std::string_view kNotUsed = "PABCUVWIJQ";
constexpr std::size_t kLargestFile = 16U << 20U;  // [bytes]

struct Row {
  std::optional<int> number;
  Tool tool;
};

Expected<void> take(char letter, double value, int column, Row& row) {
  const bool is_whole = value >= 0.0 && value == std::floor(value) &&
                        value <= static_cast<double>(std::numeric_limits<int>::max());
  if (letter == 'T') {
    if (!is_whole) {
      return fail_at(column, fmt::format("T{:.10g}: expected the number of a tool", value));
    }
    row.number = static_cast<int>(value);
    return {};
  }
  if (kNotUsed.find(letter) != std::string_view::npos) {
    return {};
  }
  if (std::abs(value) > ToolTable::kLargestNumber) {
    return fail_at(column, fmt::format("{}{:.10g}: expected at most {:g} mm", letter, value,
                                       ToolTable::kLargestNumber));
  }
  if (letter == 'D') {
    row.tool.diameter = value;
  } else {
    row.tool.offset[letter - 'X'] = value;
  }
  return {};
}

Expected<Row> read_row(std::string_view text) {
  Row row;
  std::size_t at = text.find_first_not_of(kTableBlanks);
  while (at != std::string_view::npos) {
    const int column = static_cast<int>(at) + 1;
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[at])));
    const bool is_known = letter != '\0' && std::strchr("TPXYZABCUVWDIJQ", letter) != nullptr;
    const Number number = parse_number(text.substr(at + 1));
    const std::size_t end = at + 1 + number.length;
    const bool ends_there =
        end >= text.size() || kTableBlanks.find(text[end]) != std::string_view::npos;
    if (!is_known || number.status != NumberStatus::kOk || !ends_there) {
      const std::size_t blank = std::min(text.find_first_of(kTableBlanks, at), text.size());
      return fail_at(column, fmt::format("'{}': expected one of T P X Y Z A B C U V W D I J Q and "
                                         "its number, as in T1 P1 Z50 D6",
                                         text.substr(at, std::min<std::size_t>(blank - at, 20))));
    }
    TWIN_CHECK(take(letter, number.value, column, row));
    at = text.find_first_not_of(kTableBlanks, end);
  }
  return row;
}

tl::unexpected<Error> named_at(Error error, const std::string& name, int line) {
  error.file = name;
  error.line = line;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace

Expected<ToolTable> ToolTable::read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const auto fault = [&](std::string message) {
    Error error{ErrorCode::kFile, std::move(message), {}, 0, 0};
    error.file = file.string();
    return tl::unexpected<Error>(std::move(error));
  };
  if (!stream || std::filesystem::is_directory(file)) {
    return fault(fmt::format("cannot open the tool table: {}",
                             stream ? "is a directory" : std::strerror(errno)));
  }
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad() || text.size() > kLargestFile) {
    return fault("cannot read the tool table: expected a text of at most 16 MiB");
  }
  return from_text(text, file.string());
}

Expected<ToolTable> ToolTable::from_text(std::string_view text, const std::string& name) {
  ToolTable table;
  int line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row_text = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    row_text = row_text.substr(0, row_text.find(';'));
    if (row_text.find_first_not_of(kTableBlanks) == std::string_view::npos) {
      continue;
    }
    const auto row = read_row(row_text);
    if (!row) {
      return named_at(row.error(), name, line);
    }
    if (!row->number) {
      return named_at(Error{ErrorCode::kProgram, "no T word: expected the number of the tool", {}},
                      name, line);
    }
    if (table.tools_.count(*row->number) > 0) {
      return named_at(Error{ErrorCode::kProgram,
                            fmt::format("tool {} is there twice: expected it once", *row->number),
                            {}},
                      name, line);
    }
    if (table.tools_.size() >= kMostTools) {
      return named_at(Error{ErrorCode::kProgram, fmt::format("more than {} tools", kMostTools), {}},
                      name, line);
    }
    table.tools_[*row->number] = row->tool;
  }
  return table;
}

const Tool* ToolTable::find(int number) const {
  const auto found = tools_.find(number);
  return found == tools_.end() ? nullptr : &found->second;
}

}  // namespace twin::gcode
