#include "studies/batch/sweep_results.hpp"

#include <cmath>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "studies/batch/job_file.hpp"

namespace twin::studies::batch {

extern const std::string_view kSweepPage;

namespace {

constexpr std::string_view kDataMark = "$<DATA>";

Json number_or_null(double x) { return std::isfinite(x) ? Json(rounded(x)) : Json(nullptr); }

/// The page with the results in it.
std::string page_of(const std::vector<std::string>& keys, std::size_t runs,
                    const std::vector<Candidate>& candidates, const std::vector<std::size_t>& front,
                    const std::string& title) {
  Json data;
  data["title"] = title;
  data["runs"] = runs;
  data["keys"] = Json::array();
  for (const std::string& key : keys) {
    if (key != "program") {
      data["keys"].push_back(key);
    }
  }
  data["front"] = front;
  data["rows"] = Json::array();
  for (const Candidate& candidate : candidates) {
    data["rows"].push_back({{"values", candidate.values},
                            {"time", number_or_null(candidate.merit.time)},
                            {"error", number_or_null(candidate.merit.contour_error)},
                            {"failure", candidate.failure}});
  }
  std::string page(kSweepPage);
  page.replace(page.find(kDataMark), kDataMark.size(), inside_html(data));
  return page;
}

}  // namespace

Expected<void> write_sweep(const std::vector<std::string>& keys, const std::vector<Row>& rows,
                           const std::string& title, const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) {
    return file_error(folder, "make this folder", code.value());
  }
  std::string jobs;
  for (const Row& row : rows) {
    jobs += to_line(row.point.job) + "\n";
  }
  const std::vector<Candidate> candidates = candidates_of(keys, rows);
  const std::vector<std::size_t> front = pareto_front(candidates);
  TWIN_CHECK(write_whole_file(folder / "jobs.jsonl", jobs));
  TWIN_CHECK(write_whole_file(folder / "results.csv", to_csv(keys, rows)));
  TWIN_CHECK(write_hdf5(keys, rows, folder / "results.h5"));
  TWIN_CHECK(write_whole_file(folder / "index.html",
                              page_of(keys, rows.size(), candidates, front, title)));
  if (front.empty()) {
    std::filesystem::remove(folder / "best.toml", code);
    return {};
  }
  return write_whole_file(folder / "best.toml",
                          config::to_toml(rows[candidates[front.back()].row].job.machine));
}

}  // namespace twin::studies::batch
