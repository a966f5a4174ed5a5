#include "pictures/video/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/units.hpp"

namespace twin::pictures::video {
namespace {

constexpr Colour kPanel{16, 20, 26};
constexpr Colour kText{245, 245, 245};
constexpr Colour kLabel{170, 182, 194};
constexpr Colour kPen{220, 20, 20};
constexpr double kPanelPart = 0.72;  // how much of the panel hides what is below
constexpr int kMargin = 16;          // [pixels]
constexpr int kScaleHeight = 12;     // [pixels]
constexpr const char* kScaleName = "contour error, RMS [um]";

/// A dot where the pen is. @param x,y  left upper corner of the inset
void mark_pen(Image& frame, int x, int y, const Vec2& pen) {
  const int pen_x = x + static_cast<int>(std::lround(pen.x()));
  const int pen_y = y + static_cast<int>(std::lround(pen.y()));
  frame.mix(Rectangle{pen_x - 3, pen_y - 3, 7, 7}, kText, 1.0);
  frame.mix(Rectangle{pen_x - 2, pen_y - 2, 5, 5}, kPen, 1.0);
}

}  // namespace

Overlay::Overlay(Font font, ColourScale scale, Strip strip, std::string title, double duration,
                 bool has_error)
    : font_(std::move(font)),
      scale_(scale),
      strip_(std::move(strip)),
      title_(std::move(title)),
      duration_(duration),
      has_error_(has_error) {}

void Overlay::draw(Image& frame, const Readout& readout) const {
  strip_.draw(frame, font_, readout.row.t);
  draw_readout(frame, readout.row);
  if (readout.inset.width() > 0 || has_error_) {
    draw_inset(frame, readout);
  }
}

void Overlay::draw_readout(Image& frame, const TraceRow& row) const {
  using Line = std::pair<std::string, std::string>;
  std::vector<Line> lines{
      {"feedrate", fmt::format("{:.1f} mm/s", row.feedrate)},
      {"", fmt::format("{:.0f} mm/min", units::mm_per_min_from_mm_per_s(row.feedrate))},
      {"time", fmt::format("{:.2f} / {:.2f} s", row.t, duration_)},
      {"NC line", fmt::format("{:.0f}", row.line)}};
  if (has_error_) {
    lines.emplace_back("contour error", fmt::format("{:.1f} um RMS", row.error_rms_um));
  }
  const int column = font_.width("contour error  ");
  const int width = std::max(font_.width(title_), column + font_.width("0000.00 / 0000.00 s"));
  const int step = font_.height() + 4;
  const int count = static_cast<int>(lines.size()) + (title_.empty() ? 0 : 1);
  frame.mix(Rectangle{kMargin, kMargin, width + 2 * kMargin, count * step + kMargin}, kPanel,
            kPanelPart);
  int y = kMargin + kMargin / 2;
  if (!title_.empty()) {
    font_.write(frame, 2 * kMargin, y, title_, kText);
    y += step;
  }
  for (const auto& [label, value] : lines) {
    font_.write(frame, 2 * kMargin, y, label, kLabel);
    font_.write(frame, 2 * kMargin + column, y, value, kText);
    y += step;
  }
}

void Overlay::draw_inset(Image& frame, const Readout& readout) const {
  const Image& inset = readout.inset;
  const int below = has_error_ ? kScaleHeight + font_.height() + kMargin / 2 + 2 : 0;
  const int width = std::max(
      inset.width(), has_error_ ? font_.width(std::string("000  ") + kScaleName + "  000") : 0);
  const Rectangle panel{frame.width() - width - 2 * kMargin - kMargin / 2,
                        frame.height() - strip_.height() - inset.height() - below - 2 * kMargin,
                        width + kMargin, inset.height() + below + kMargin};
  const int x = panel.x + (panel.width - inset.width()) / 2;
  const int y = panel.y + kMargin / 2;
  frame.mix(panel, kPanel, kPanelPart);
  if (inset.width() > 0) {
    frame.paste(inset, x, y);
    mark_pen(frame, x, y, readout.pen);
  }
  if (has_error_) {
    draw_scale(frame,
               {panel.x + kMargin / 2, y + inset.height() + kMargin / 2, width, kScaleHeight});
  }
}

void Overlay::draw_scale(Image& frame, const Rectangle& area) const {
  for (int i = 0; i < area.width; ++i) {
    const double part = static_cast<double>(i) / (area.width - 1);
    frame.mix(Rectangle{area.x + i, area.y, 1, area.height}, scale_.colour(part * scale_.end_um()),
              1.0);
  }
  const int y = area.y + area.height + 2;
  const std::string end = fmt::format("{:g}", scale_.end_um());
  font_.write(frame, area.x, y, "0", kText);
  font_.write(frame, area.x + area.width - font_.width(end), y, end, kText);
  font_.write(frame, area.x + (area.width - font_.width(kScaleName)) / 2, y, kScaleName, kLabel);
}

Rectangle inset_size(int frame_width, int frame_height, const Vec2& extent) {
  const double most_width = 0.28 * frame_width;
  const double most_height = 0.36 * frame_height;
  const double x = std::max(extent.x(), 1e-3);
  const double y = std::max(extent.y(), 1e-3);
  const double scale = std::min(most_width / x, most_height / y);
  constexpr double least = 48.0;  // [pixels]
  return {0, 0, static_cast<int>(std::max(x * scale, least)),
          static_cast<int>(std::max(y * scale, least))};
}

}  // namespace twin::pictures::video
