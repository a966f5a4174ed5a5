#include "nc_programs/generate/nc_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twin::programs {
namespace {

/// Rounds to 1e-4; + 0.0 turns -0 into 0.
double four_decimals(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

}  // namespace

Point2 round_to_file(const Point2& p) { return {four_decimals(p.x()), four_decimals(p.y())}; }

void NcText::comment(const std::string& text) { text_ += "(" + text + ")\n"; }

void NcText::start_of_program(double feed_mm_per_min) {
  text_ += fmt::format("G21 G17 G90 G94\nG64\nG01 F{:g}\n", feed_mm_per_min);
}

void NcText::raw(const std::string& text) { text_ += text + "\n"; }

void NcText::line_to(const Point2& p) {
  const Point2 r = round_to_file(p);
  text_ += fmt::format("X{:.4f} Y{:.4f}\n", r.x(), r.y());
}

std::string NcText::end_of_program() { return text_ + "M30\n"; }

}  // namespace twin::programs
