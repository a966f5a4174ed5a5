#include "gcode/values/message.hpp"

#include <fmt/format.h>

#include "gcode/text/characters.hpp"
#include "gcode/values/number.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {
namespace {

constexpr int kDecimals = 6;  // until a format says otherwise
constexpr std::string_view kUnknown = "######";

/// The text behind the keyword of an active comment, and whether its parameters are replaced.
struct Active {
  std::string_view text;
  bool is_expanded = false;
};

std::optional<Active> active(std::string_view comment) {
  struct Kind {
    std::string_view word;
    bool is_expanded;
  };
  constexpr Kind kKinds[] = {{"MSG", false}, {"DEBUG", true}, {"PRINT", true}, {"LOG", true}};
  for (const Kind& kind : kKinds) {
    std::size_t at = 0;
    std::size_t matched = 0;
    for (; matched < kind.word.size(); ++matched, ++at) {
      skip_blanks(comment, at);
      if (upper(at_or_zero(comment, at)) != kind.word[matched]) {
        break;
      }
    }
    skip_blanks(comment, at);
    if (matched == kind.word.size() && at_or_zero(comment, at) == ',') {
      return Active{comment.substr(at + 1), kind.is_expanded};
    }
  }
  return std::nullopt;
}

/// Reads a format as %d, %f, %lf or %.3f at a place. @returns its decimals, or nothing
std::optional<int> read_format(std::string_view text, std::size_t& at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("%d")) {
    at += 2;
    return 0;
  }
  if (rest.starts_with("%f")) {
    at += 2;
    return 4;
  }
  if (rest.starts_with("%lf")) {
    at += 3;
    return kDecimals;
  }
  if (rest.starts_with("%.") && is_digit(at_or_zero(rest, 2)) && at_or_zero(rest, 3) == 'f') {
    at += 4;
    return rest[2] - '0';
  }
  return std::nullopt;
}

/// The value of a parameter at a place, whose # stands there; steps over it where it is one.
std::string value_at(std::string_view text, std::size_t& at, int decimals,
                     const Parameters& parameters) {
  std::size_t behind = at + 1;
  Expected<double> value = 0.0;
  if (at_or_zero(text, behind) == '<') {
    const std::size_t end = text.find('>', behind);
    if (end == std::string_view::npos) {
      ++at;
      return "#";
    }
    value = parameters.named(text.substr(behind + 1, end - behind - 1), 0);
    behind = end + 1;
  } else {
    const Number number = parse_number(text.substr(behind));
    if (number.status != NumberStatus::kOk) {
      ++at;
      return "#";
    }
    value = parameters.numbered(number.value, 0);
    behind += number.length;
  }
  at = behind;
  return value ? fmt::format("{:.{}f}", *value, decimals) : std::string(kUnknown);
}

}  // namespace

std::optional<std::string> message_of(std::string_view comment, const Parameters& parameters) {
  const auto found = active(comment);
  if (!found) {
    return std::nullopt;
  }
  std::string message;
  int decimals = kDecimals;
  for (std::size_t at = 0; at < found->text.size();) {
    if (found->is_expanded && found->text[at] == '#') {
      message += value_at(found->text, at, decimals, parameters);
    } else if (const auto format =
                   found->is_expanded ? read_format(found->text, at) : std::nullopt) {
      decimals = *format;
    } else {
      message.push_back(found->text[at++]);
    }
  }
  const std::size_t begin = message.find_first_not_of(' ');
  return begin == std::string::npos ? std::string() : message.substr(begin);
}

}  // namespace twin::gcode
