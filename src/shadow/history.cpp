#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/text_table.hpp"
#include "shadow/report.hpp"

// The history of a machine over its runs.
namespace twin::shadow {
namespace {

constexpr std::string_view kHistoryHeader =
    "time_utc,program,axis,channel,parameter,change,deviation,found";
constexpr std::size_t kHistoryColumns = 8;
constexpr std::size_t kFewestRuns = 4;
constexpr double kSure = 5.0;  // deviations of a slope
constexpr std::array<const char*, hal::kServoAxes> kHistoryAxes{"x", "y"};

/// Fields of a line of CSV, in which one may be quoted.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

struct Point {
  double change;
  double deviation;
};
/// Of each parameter: axis, channel, parameter.
using History = std::map<std::string, std::vector<Point>>;

bool take_number(const std::string& text, double& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

Expected<History> read_history(const std::filesystem::path& file, std::string_view text) {
  History history;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const auto error = [&](const std::string& message) {
      return tl::unexpected(Error{ErrorCode::kFile, message, file.string(), number, 0});
    };
    if (number == 1) {
      if (line != kHistoryHeader) {
        return error(fmt::format("this is no history of a shadow: expected '{}'", kHistoryHeader));
      }
      continue;
    }
    const std::vector<std::string> fields = fields_of(line);
    Point point{};
    if (fields.size() != kHistoryColumns || !take_number(fields[5], point.change) ||
        !take_number(fields[6], point.deviation) || !(point.deviation > 0.0)) {
      return error(fmt::format("'{}': expected {} fields, {}", line.substr(0, 60), kHistoryColumns,
                               kHistoryHeader));
    }
    history[fmt::format("axis {}, {}: {}", fields[2], fields[3], fields[4])].push_back(point);
  }
  return history;
}

/// Slope of a line through the points, by weights of their deviations.
std::string trend_of(const std::string& name, const std::vector<Point>& points) {
  double s = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double w = 1.0 / (points[k].deviation * points[k].deviation);
    const auto x = static_cast<double>(k);
    s += w;
    sx += w * x;
    sy += w * points[k].change;
    sxx += w * x * x;
    sxy += w * x * points[k].change;
  }
  const double det = s * sxx - sx * sx;
  const double slope = (s * sxy - sx * sy) / det;
  const double level = (sy - slope * sx) / s;
  double misfit = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double off =
        (points[k].change - level - slope * static_cast<double>(k)) / points[k].deviation;
    misfit += off * off;
  }
  const double excess = std::max(misfit / static_cast<double>(points.size() - 2), 1.0);
  const double deviation = std::sqrt(excess * s / det);
  if (std::abs(slope) < kSure * deviation) {
    return {};
  }
  return fmt::format("trend, {}: {:+.3g} (+- {:.2g}) from run to run over {} runs", name, slope,
                     deviation, points.size());
}

}  // namespace

Expected<std::vector<std::string>> add_to_history(const std::filesystem::path& file,
                                                  const std::string& when,
                                                  const std::string& program,
                                                  const ShadowReport& report) {
  std::string text;
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    TWIN_TRY(text, read_whole_file(file));
  } else {
    text = std::string(kHistoryHeader) + "\n";
  }
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    for (const AxisShadow::Estimate& estimate : report.axis[axis].estimates) {
      const bool is_found = report.axis[axis].found.has_value() &&
                            report.axis[axis].found->cause.cause == estimate.cause;
      text += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{}\n", when, quote_csv(program),
                          kHistoryAxes[axis], name_of(estimate.channel), name_of(estimate.cause),
                          estimate.change, estimate.deviation, is_found ? 1 : 0);
    }
  }
  TWIN_TRY(const History history, read_history(file, text));
  TWIN_CHECK(write_whole_file(file, text, Durability::kCached));
  std::vector<std::string> trends;
  for (const auto& [name, points] : history) {
    if (points.size() >= kFewestRuns) {
      std::string trend = trend_of(name, points);
      if (!trend.empty()) {
        trends.push_back(std::move(trend));
      }
    }
  }
  return trends;
}

}  // namespace twin::shadow
