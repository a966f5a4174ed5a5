#include "tests/fuzz/chain/byte_source.hpp"

#include <cmath>

namespace twin::fuzz {

unsigned ByteSource::byte() noexcept {
  if (bytes_.empty()) {
    return 0;
  }
  const unsigned value = bytes_.front();
  bytes_ = bytes_.subspan(1);
  return value;
}

double ByteSource::uniform(double low, double high) noexcept {
  const unsigned both = 256U * byte();
  return low + (high - low) * (both + byte()) / 65535.0;
}

double ByteSource::log_uniform(double low, double high) noexcept {
  return low * std::pow(high / low, uniform(0.0, 1.0));
}

}  // namespace twin::fuzz
