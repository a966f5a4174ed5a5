#include "results/trace/limit_writer.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "results/trace/columns.hpp"

namespace twin::results {

Expected<LimitWriter> LimitWriter::create(const std::filesystem::path& directory) {
  constexpr std::array<std::string_view, 2> columns{"t_s", "feedrate_limit_mm_per_s"};
  const std::filesystem::path target = directory / kLimitName;
  std::filesystem::path temporary = target;
  temporary += ".tmp";
  TWIN_TRY(CsvFile file, CsvFile::create(target, std::move(temporary), columns, OnAbandon::kRemove,
                                         Durability::kCached));
  return LimitWriter(std::move(file));
}

Expected<void> LimitWriter::write(double t, double limit) {
  if (!std::isfinite(limit)) {
    return {};
  }
  const bool is_same = limit == last_limit_;
  if (!is_same) {
    TWIN_CHECK(flush());
  }
  last_t_ = t;
  last_limit_ = limit;
  is_pending_ = true;
  return is_same ? Expected<void>{} : flush();
}

Expected<void> LimitWriter::flush() {
  if (!std::exchange(is_pending_, false)) {
    return {};
  }
  const std::array<double, 2> row{last_t_, last_limit_};
  return file_.write(row);
}

Expected<void> LimitWriter::commit() {
  return flush().and_then([this] { return file_.commit(); });
}

}  // namespace twin::results
