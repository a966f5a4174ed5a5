#include "studies/batch/sweep.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "core/units.hpp"
#include "studies/batch/job_file.hpp"
#include "studies/batch/samples.hpp"

namespace twin::studies::batch {
namespace {

/// The rows of a table of values, one value a key.
using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::vector<ListedKey>& grid) {
  Rows rows{{}};
  for (const ListedKey& listed : grid) {
    Rows next;
    next.reserve(rows.size() * listed.values.size());
    for (const auto& row : rows) {
      for (const std::string& value : listed.values) {
        next.push_back(row);
        next.back().push_back(value);
      }
    }
    rows = std::move(next);
  }
  return rows;
}

Rows rows_of_hypercube(const Sweep& sweep) {
  if (sweep.hypercube_count == 0) {
    return {{}};
  }
  Rows rows;
  for (const auto& point :
       latin_hypercube(sweep.hypercube_count, sweep.hypercube.size(), sweep.hypercube_seed)) {
    rows.emplace_back();
    for (std::size_t k = 0; k < point.size(); ++k) {
      const DrawnKey& key = sweep.hypercube[k];
      rows.back().push_back(fmt::format("{:.9g}", key.from + point[k] * (key.to - key.from)));
    }
  }
  return rows;
}

Rows rows_of_normal(const Sweep& sweep) {
  if (sweep.normal_count == 0) {
    return {{}};
  }
  Rows rows;
  for (const auto& point :
       normal_samples(sweep.normal_count, sweep.normal.size(), sweep.normal_seed)) {
    rows.emplace_back();
    for (std::size_t k = 0; k < point.size(); ++k) {
      const DrawnKey& key = sweep.normal[k];
      rows.back().push_back(fmt::format("{:.9g}", key.from + point[k] * key.to));
    }
  }
  return rows;
}

/// How many jobs, as a real number, for it may be beyond all whole ones.
double count_of(const Sweep& sweep) {
  double count = 1.0;
  for (const ListedKey& listed : sweep.grid) {
    count *= static_cast<double>(listed.values.size());
  }
  count *= sweep.hypercube_count > 0 ? static_cast<double>(sweep.hypercube_count) : 1.0;
  return count * (sweep.normal_count > 0 ? static_cast<double>(sweep.normal_count) : 1.0);
}

void apply(const std::string& key, const std::string& value, Job& job) {
  if (key == "program") {
    job.program = value;
  } else if (key == "feedrate_mm_per_min") {
    job.feedrate = units::mm_per_s_from_mm_per_min(std::strtod(value.c_str(), nullptr));
  } else {
    job.settings.push_back(key + "=" + value);
  }
}

}  // namespace

std::vector<std::string> keys_of(const Sweep& sweep) {
  std::vector<std::string> keys;
  for (const ListedKey& key : sweep.grid) {
    keys.push_back(key.key);
  }
  for (const auto* const drawn : {&sweep.hypercube, &sweep.normal}) {
    for (const DrawnKey& key : *drawn) {
      keys.push_back(key.key);
    }
  }
  return keys;
}

Expected<std::vector<SweepPoint>> points_of(const Sweep& sweep) {
  const double count = count_of(sweep);
  if (count > static_cast<double>(kMostJobs)) {
    return fail(ErrorCode::kUsage,
                fmt::format("the sweep has {:.3g} jobs; at most {} are taken", count, kMostJobs));
  }
  const std::vector<std::string> keys = keys_of(sweep);
  std::vector<SweepPoint> points;
  points.reserve(static_cast<std::size_t>(count));
  const Rows hypercube = rows_of_hypercube(sweep);
  const Rows normal = rows_of_normal(sweep);
  for (const auto& listed : rows_of(sweep.grid)) {
    for (const auto& drawn : hypercube) {
      for (const auto& random : normal) {
        SweepPoint point{sweep.base, listed};
        point.values.insert(point.values.end(), drawn.begin(), drawn.end());
        point.values.insert(point.values.end(), random.begin(), random.end());
        for (std::size_t k = 0; k < keys.size(); ++k) {
          apply(keys[k], point.values[k], point.job);
        }
        points.push_back(std::move(point));
      }
    }
  }
  return points;
}

}  // namespace twin::studies::batch
