#include "core/rounded.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace twin {

double rounded(double x) { return std::strtod(fmt::format("{:.9g}", x).c_str(), nullptr); }

}  // namespace twin
