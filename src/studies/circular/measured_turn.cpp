#include "studies/circular/measured_turn.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "results/trace/csv_reader.hpp"
#include "studies/circular/circle_program.hpp"

namespace twin::studies::circular {
namespace {

constexpr std::size_t kFewestRows = 60;

}  // namespace

Expected<MeasuredTurn> read_measured_turn(const std::filesystem::path& trace) {
  constexpr std::array<std::string_view, 6> kWanted{"line",       "feedrate_mm_per_s", "x_table_mm",
                                                    "y_table_mm", "x_enc_mm",          "y_enc_mm"};
  MeasuredTurn turn;
  const auto take = [&turn](std::span<const double> row) {
    if (row[0] == static_cast<double>(kMeasuredLine)) {
      turn.feedrate += row[1];
      turn.table.emplace_back(row[2], row[3]);
      turn.encoder.emplace_back(row[4], row[5]);
    }
  };
  TWIN_CHECK(results::read_rows(trace, kWanted, take));
  const std::size_t count = turn.table.size();
  if (count < kFewestRows) {
    return fail(ErrorCode::kProgram,
                fmt::format("the measured turn has {} set points, and {} are needed: take a larger "
                            "radius, a lower feedrate or a shorter interpolator.period_ms",
                            count, kFewestRows));
  }
  turn.feedrate /= static_cast<double>(count);
  return turn;
}

}  // namespace twin::studies::circular
