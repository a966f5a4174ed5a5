#include "pictures/page/page_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/vec.hpp"
#include "results/trace/decimator.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::pictures {
namespace {

struct Source {
  std::string_view name;
  double step;
  bool is_needed;
  bool is_watched;  // its extremes are kept where rows are left out
};

// Steps are below what an encoder or a converter resolves, so that no figure on the page differs
// from the file's at the digits that are shown.
constexpr std::array<Source, 20> kSources{{{"t_s", 1e-6, true, false},
                                           {"x_cmd_mm", 1e-5, true, true},
                                           {"y_cmd_mm", 1e-5, true, true},
                                           {"z_cmd_mm", 1e-4, false, true},
                                           {"segment", 1.0, false, false},
                                           {"line", 1.0, false, false},
                                           {"feedrate_mm_per_s", 1e-4, false, true},
                                           {"contour_error_um", 1e-3, false, true},
                                           {"contour_error_signed_um", 1e-3, false, true},
                                           {"x_tracking_error_um", 1e-2, false, true},
                                           {"y_tracking_error_um", 1e-2, false, true},
                                           {"x_drive_V", 1e-3, false, true},
                                           {"y_drive_V", 1e-3, false, true},
                                           {"x_torque_Nm", 1e-4, false, true},
                                           {"y_torque_Nm", 1e-4, false, true},
                                           {"x_friction_N", 1e-2, false, true},
                                           {"y_friction_N", 1e-2, false, true},
                                           {"table_contour_error_signed_um", 1e-3, false, true},
                                           {"command_contour_error_signed_um", 1e-3, false, true},
                                           {"rapid", 1.0, false, false}}};

constexpr std::string_view kSigned = "contour_error_signed_um";
constexpr std::size_t kLookBack = 60;  // rows that the machine may lag; more follow a slower loop

Error not_a_trace(const std::filesystem::path& trace, std::string_view column) {
  return {ErrorCode::kFile,
          fmt::format("is no trace that a page can show: it has no column {}", column),
          trace.string(), 1, 0};
}

using Columns = std::vector<PageColumn>;

const PageColumn* find(const Columns& columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &PageColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

/// Step of the time, such that the whole trace fits into 32 bits.
double time_step(double last) {
  double step = 1e-6;
  while (last / step > 2e9) {
    step *= 10.0;
  }
  return step;
}

/// Size of the acceleration of the set points, from rows that follow each other [mm/s^2].
PageColumn acceleration_of(const Columns& columns) {
  PageColumn a{"acceleration_mm_per_s2", 0.1, {}};
  const std::vector<double>& t = columns[0].values;
  a.values.assign(t.size(), 0.0);
  const PageColumn* const z = find(columns, "z_cmd_mm");
  const std::array<const PageColumn*, 3> axes{&columns[1], &columns[2], z};
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const double before = t[i] - t[i - 1];
    const double after = t[i + 1] - t[i];
    if (before <= 0.0 || std::abs(after - before) > 1e-6) {
      continue;
    }
    double sum = 0.0;
    for (const PageColumn* const axis : axes) {
      if (axis != nullptr) {
        const auto& p = axis->values;
        const double second = (p[i + 1] - 2.0 * p[i] + p[i - 1]) / (before * before);
        sum += second * second;
      }
    }
    a.values[i] = std::sqrt(sum);
  }
  return a;
}

/// Gives the contour error its sign.
void sign_contour_error(Columns& columns) {
  const PageColumn* const size = find(columns, "contour_error_um");
  const PageColumn* const ex = find(columns, "x_tracking_error_um");
  const PageColumn* const ey = find(columns, "y_tracking_error_um");
  if (size == nullptr || ex == nullptr || ey == nullptr) {
    return;
  }
  const auto& x = columns[1].values;
  const auto& y = columns[2].values;
  PageColumn with_sign{std::string(kSigned), size->step, size->values};
  Vec2 direction = Vec2::UnitX();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec2 encoder{x[i] - 1e-3 * ex->values[i], y[i] - 1e-3 * ey->values[i]};
    const auto from = [&](std::size_t k) { return Vec2(encoder - Vec2(x[k], y[k])); };
    std::size_t nearest = i;
    for (std::size_t k = i; k > 0 && i - k < kLookBack; --k) {
      nearest = from(k - 1).squaredNorm() < from(nearest).squaredNorm() ? k - 1 : nearest;
    }
    if (nearest > 0) {
      const Vec2 way{x[nearest] - x[nearest - 1], y[nearest] - y[nearest - 1]};
      direction = way.squaredNorm() > 0.0 ? way : direction;
    }
    const Vec2 off = from(nearest);
    if (direction.x() * off.y() - direction.y() * off.x() < 0.0) {
      with_sign.values[i] = -with_sign.values[i];
    }
  }
  columns.push_back(std::move(with_sign));
}

/// The limit in force at each row, from its changes in a file.
std::optional<PageColumn> limit_of(const Columns& columns, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 2> kNames{"t_s", "feedrate_limit_mm_per_s"};
  std::vector<std::array<double, 2>> changes;
  const auto take = [&changes](std::span<const double> row) {
    changes.push_back({row[0], row[1]});
  };
  if (!results::read_rows(file, kNames, take) || changes.empty()) {
    return std::nullopt;
  }
  PageColumn limit{"feedrate_limit_mm_per_s", 1e-2, {}};
  std::size_t next = 0;
  for (const double t : columns[0].values) {
    while (next + 1 < changes.size() && changes[next + 1][0] <= t + 1e-9) {
      ++next;
    }
    limit.values.push_back(changes[next][1]);
  }
  return limit;
}

}  // namespace

Expected<PageRows> read_page_rows(const std::filesystem::path& trace,
                                  const std::filesystem::path& limits, std::size_t most) {
  TWIN_TRY(results::TraceReader reader, results::TraceReader::open(trace));
  std::vector<std::string_view> names;
  std::vector<std::size_t> watched;
  PageRows page;
  for (const Source& source : kSources) {
    if (reader.has(source.name)) {
      if (source.is_watched) {
        watched.push_back(names.size());
      }
      names.push_back(source.name);
      page.columns.push_back({std::string(source.name), source.step, {}});
    } else if (source.is_needed) {
      return tl::unexpected(not_a_trace(trace, source.name));
    }
  }
  TWIN_CHECK(reader.select(names));
  results::Decimator decimator(names.size(), watched, most);
  TWIN_CHECK(reader.for_each_row([&](std::span<const double> row) {
    ++page.rows_of_trace;
    page.last_time = row[0];
    decimator.push(row);
  }));
  if (page.rows_of_trace == 0) {
    return tl::unexpected(
        Error{ErrorCode::kFile, "has no rows: nothing moved", trace.string(), 1, 0});
  }
  const results::Table table = decimator.finish();
  page.is_thinned = page.rows_of_trace > most;
  for (std::size_t i = 0; i < names.size(); ++i) {
    page.columns[i].values.reserve(table.rows());
    for (std::size_t row = 0; row < table.rows(); ++row) {
      page.columns[i].values.push_back(table.at(row, i));
    }
  }
  page.columns.front().step = time_step(page.last_time);
  page.columns.push_back(acceleration_of(page.columns));
  if (find(page.columns, kSigned) == nullptr) {
    sign_contour_error(page.columns);
  }
  if (auto limit = limit_of(page.columns, limits)) {
    page.columns.push_back(*std::move(limit));
  }
  return page;
}

}  // namespace twin::pictures
