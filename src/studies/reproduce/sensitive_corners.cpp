#include "studies/reproduce/sensitive_corners.hpp"

#include <algorithm>
#include <cmath>

namespace twin::studies::reproduce {

std::vector<Moment> sensitive_corners(std::span<const Moment> motion, double drop) {
  std::vector<Moment> corners;
  if (motion.empty()) {
    return corners;
  }
  Moment highest = motion.front();
  Moment lowest = motion.front();
  bool falls = false;  // the feedrate has fallen by more than drop since highest
  for (const Moment& moment : motion) {
    if (!falls) {
      highest = moment.feedrate > highest.feedrate ? moment : highest;
      falls = moment.feedrate < highest.feedrate - drop;
      lowest = moment;
    } else {
      lowest = moment.feedrate < lowest.feedrate ? moment : lowest;
      if (moment.feedrate > lowest.feedrate + drop) {
        corners.push_back(lowest);
        highest = moment;
        falls = false;
      }
    }
  }
  return corners;
}

std::string corner_letter(std::size_t index) {
  std::string text(1, static_cast<char>('A' + index % 26));
  if (index >= 26) {
    text += std::to_string(index / 26 + 1);
  }
  return text;
}

Window most_violent(std::span<const Moment> motion, double duration) {
  if (motion.empty()) {
    return {};
  }
  const double top = std::ranges::max(motion, {}, &Moment::feedrate).feedrate;
  const auto is_fast = [&](const Moment& moment) { return moment.feedrate >= 0.99 * top; };
  const auto first = std::ranges::find_if(motion, is_fast);
  const auto last = std::find_if(motion.rbegin(), motion.rend(), is_fast).base();
  double variation = 0.0;
  double best = -1.0;
  Window window{motion.front().t, motion.front().t + duration};
  auto begin = first;
  for (auto end = first; end != last; ++end) {
    if (end != first) {
      variation += std::abs(end->feedrate - std::prev(end)->feedrate);
    }
    while (end->t - begin->t > duration) {
      variation -= std::abs(std::next(begin)->feedrate - begin->feedrate);
      ++begin;
    }
    if (variation > best * (1.0 + 1e-9) + 1e-9) {
      best = variation;
      window = {end->t - duration, end->t};
    }
  }
  return window;
}

}  // namespace twin::studies::reproduce
