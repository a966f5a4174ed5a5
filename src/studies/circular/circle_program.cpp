#include "studies/circular/circle_program.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "core/units.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::studies::circular {
namespace {

/// A number as NC programs have it: picometres, no exponent, no needless zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.6f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

constexpr std::size_t kFewestRows = 60;

}  // namespace

std::string_view short_name(Sense sense) { return sense == Sense::kClockwise ? "cw" : "ccw"; }

std::string circle_program(double radius, double feedrate, Sense sense) {
  const bool is_clockwise = sense == Sense::kClockwise;
  const std::string x = number(0.8 * radius);
  const std::string y = number(0.6 * radius);
  const std::string arc = fmt::format("G0{} X{} Y{} I-{} J-{}", is_clockwise ? 2 : 3, x, y, x, y);
  const std::string half =
      fmt::format("G0{} X-{} Y-{} I-{} J-{}", is_clockwise ? 2 : 3, x, y, x, y);
  return fmt::format(
      "(circular test, {}: radius {} mm about X0 Y0, {} mm/min)\n"
      "(starts at X0 Y0; line {} is the measured turn)\n"
      "G21 G17 G90 G94\n"
      "G64\n"
      "G01 X{} Y{} F{}\n"
      "{} (run-in)\n"
      "{} (measured turn)\n"
      "{} (run-out)\n"
      "G01 X0 Y0\n"
      "M30\n",
      is_clockwise ? "clockwise" : "counter-clockwise", number(radius),
      number(units::mm_per_min_from_mm_per_s(feedrate)), kMeasuredLine, x, y,
      number(units::mm_per_min_from_mm_per_s(feedrate)), arc, arc, half);
}

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
