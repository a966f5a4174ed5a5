#include "operator/commands.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "core/json.hpp"

namespace twin::operator_station {
namespace {

using runtime::kHighestOverride;
using runtime::OperatorPanel;

constexpr double kStep = 10.0;  // of the keys + and - [%]
constexpr std::array<std::string_view, 5> kStates{"waiting", "moving", "holding", "starved",
                                                  "ended"};

std::string_view name_of(runtime::MotionState state) {
  return kStates[static_cast<std::size_t>(state)];
}

std::string error(const std::string& text) { return to_ascii_line({{"error", text}}); }

std::string status(const OperatorPanel& panel) {
  const OperatorPanel::Display shown = panel.display();
  const OperatorPanel::Wish wish = panel.wish();
  return to_ascii_line({{"state", name_of(shown.state)},
                        {"t_s", shown.time},
                        {"override_percent", wish.percent},
                        {"hold", wish.is_held},
                        {"planned_for_percent", shown.percent},
                        {"feedrate_mm_per_s", shown.feedrate},
                        {"line", shown.line}});
}

std::string set_override(std::string_view text, OperatorPanel& panel) {
  double percent = -1.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), percent);
  const bool is_number = code == std::errc() && end == text.data() + text.size();
  if (!is_number || !(percent >= 0.0 && percent <= kHighestOverride)) {
    return error(fmt::format("override wants a percentage within 0 and {:g}, as in: override 50",
                             kHighestOverride));
  }
  panel.set_override(percent);
  return status(panel);
}

std::string resume(OperatorPanel& panel) {
  if (panel.wish().percent == 0.0) {
    return error("the override is 0 %: it holds until another one is set");
  }
  panel.hold(false);
  return status(panel);
}

/// Without white space at its ends.
std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const auto first = text.find_first_not_of(kSpace);
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

}  // namespace

std::string answer(std::string_view line, OperatorPanel& panel) {
  const std::string_view text = trimmed(line);
  const auto space = text.find(' ');
  const std::string_view command = text.substr(0, space);
  const std::string_view value =
      space == std::string_view::npos ? std::string_view() : trimmed(text.substr(space));
  if (command == "override") {
    return set_override(value, panel);
  }
  if (value.empty()) {
    if (command == "hold") {
      panel.hold(true);
      return status(panel);
    }
    if (command == "resume") {
      return resume(panel);
    }
    if (command == "status") {
      return status(panel);
    }
  }
  return error("commands are: override PERCENT, hold, resume, status");
}

void press(char key, OperatorPanel& panel) {
  const OperatorPanel::Wish wish = panel.wish();
  if (key == ' ') {
    panel.hold(!wish.is_held);
  } else if (key == '+' || key == '=') {
    panel.set_override(wish.percent + kStep);
  } else if (key == '-' || key == '_') {
    panel.set_override(wish.percent - kStep);
  } else if (key == '0') {
    panel.set_override(100.0);
  } else if (key >= '1' && key <= '9') {
    panel.set_override(kStep * (key - '0'));
  }
}

std::string status_line(const OperatorPanel& panel) {
  const OperatorPanel::Display shown = panel.display();
  const OperatorPanel::Wish wish = panel.wish();
  return fmt::format(
      "{:8.2f} s  line {:<7} {:7.2f} mm/s  override {:3.0f} %  {:<8} [+ - 0-9 space]", shown.time,
      shown.line, shown.feedrate, wish.percent, wish.holds() ? "HOLD" : name_of(shown.state));
}

}  // namespace twin::operator_station
