#pragma once

#include <string>

namespace twin::studies::convert {

/// A number in the fewest digits with at most so many decimals: "1.25", "-3", "0"; never an
/// exponent, never "-0".
std::string number(double value, int decimals);

/// The value that number() writes.
double rounded(double value, int decimals);

}  // namespace twin::studies::convert
