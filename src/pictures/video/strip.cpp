#include "pictures/video/strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pictures/video/colour_scale.hpp"

namespace twin::pictures::video {
namespace {

constexpr Colour kStripPaper{250, 250, 247};
constexpr Colour kRule{214, 214, 210};
constexpr Colour kFeedrate{0, 114, 178};  // Okabe and Ito's blue and vermilion
constexpr Colour kError{213, 94, 0};
constexpr Colour kNow{30, 30, 30};
constexpr double kPale = 0.68;   // how much of the paper lies over what is to come
constexpr int kLabels = 150;     // room at the left [pixels]
constexpr int kStripMargin = 8;  // [pixels]

int plot_width(int width) { return std::max(width - kLabels - kStripMargin, 1); }

/// Largest value of the steps under each column.
template <class Value>
std::vector<double> columns(const History& history, double duration, int width, Value value) {
  std::vector<double> result(static_cast<std::size_t>(width), 0.0);
  const auto& steps = history.steps();
  const double per_column = duration / width / history.step_length();
  for (int x = 0; x < width && !steps.empty(); ++x) {
    const double last = static_cast<double>(steps.size()) - 1.0;
    const auto from = static_cast<std::size_t>(std::clamp(x * per_column, 0.0, last));
    const auto to = static_cast<std::size_t>(std::clamp((x + 1) * per_column, 0.0, last));
    for (std::size_t i = from; i <= to; ++i) {
      result[static_cast<std::size_t>(x)] =
          std::max(result[static_cast<std::size_t>(x)], value(steps[i]));
    }
  }
  return result;
}

}  // namespace

Strip::Strip(const History& history, double duration, double error_end_um, bool has_error,
             int width, int height)
    : image_(width, height, kStripPaper),
      duration_(std::max(duration, 1e-9)),
      error_end_um_(error_end_um),
      has_error_(has_error) {
  const auto feedrates = columns(history, duration_, plot_width(width),
                                 [](const History::Step& step) { return step.feedrate; });
  feedrate_end_ = round_up(1.1 * *std::max_element(feedrates.begin(), feedrates.end()));
  fill(kStripMargin, kFeedrate, feedrates, feedrate_end_);
  if (has_error) {
    fill(2 * kStripMargin + panel_height(), kError,
         columns(history, duration_, plot_width(width),
                 [](const History::Step& step) { return step.error_um; }),
         error_end_um_);
  }
}

int Strip::panel_height() const noexcept {
  return has_error_ ? (height() - 3 * kStripMargin) / 2 : height() - 2 * kStripMargin;
}

void Strip::fill(int top, Colour colour, const std::vector<double>& values, double end) {
  const int room = panel_height();
  const int below = top + room;
  image_.mix(Rectangle{kLabels, top, static_cast<int>(values.size()), 1}, kRule, 1.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int x = kLabels + static_cast<int>(i);
    const double part = std::clamp(values[i] / end, 0.0, 1.0);
    const int tall = static_cast<int>(std::lround(part * room));
    image_.mix(Rectangle{x, below - tall, 1, tall}, colour, 0.30);
    image_.mix(Rectangle{x, below - tall, 1, std::min(2, std::max(tall, 1))}, colour, 1.0);
  }
  image_.mix(Rectangle{kLabels, below, static_cast<int>(values.size()), 1}, kRule, 1.0);
}

void Strip::draw(Image& frame, const Font& font, double t) const {
  const int top = frame.height() - image_.height();
  frame.paste(image_, 0, top);
  const int width = plot_width(image_.width());
  const int now = kLabels + static_cast<int>(std::clamp(t / duration_, 0.0, 1.0) * (width - 1));
  frame.mix(Rectangle{now + 1, top, kLabels + width - now - 1, image_.height()}, kStripPaper,
            kPale);
  frame.mix(Rectangle{now - 1, top, 2, image_.height()}, kNow, 1.0);
  frame.mix(Rectangle{0, top, frame.width(), 1}, kRule, 1.0);
  font.write(frame, kStripMargin, top + kStripMargin, fmt::format("{:g} mm/s", feedrate_end_),
             kFeedrate);
  if (has_error_) {
    font.write(frame, kStripMargin, top + 2 * kStripMargin + panel_height(),
               fmt::format("{:g} um", error_end_um_), kError);
  }
}

int strip_height(int frame_height) { return frame_height / 8; }

}  // namespace twin::pictures::video
