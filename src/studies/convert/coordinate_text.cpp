#include "studies/convert/coordinate_text.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace twin::studies::convert {

std::string number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
      text.pop_back();
    }
  }
  return text == "-0" ? "0" : text;
}

double rounded(double value, int decimals) {
  return std::strtod(number(value, decimals).c_str(), nullptr);
}

}  // namespace twin::studies::convert
