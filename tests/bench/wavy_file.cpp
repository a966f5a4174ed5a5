#include "tests/bench/wavy_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <system_error>

namespace twin::bench {

WavyFile::WavyFile(std::int64_t blocks, double block_length, PathShape shape)
    : path_(std::filesystem::temp_directory_path() / fmt::format("twin_wavy_{}.nc", ::getpid())) {
  std::FILE* const file = std::fopen(path_.c_str(), "wb");
  if (file == nullptr) {
    throw std::runtime_error("cannot write " + path_.string());
  }
  fmt::print(file, "G21 G90 G17 G64\nG01 F3000\n");
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  for (std::int64_t i = 0; i < blocks; ++i) {
    const double s = block_length * static_cast<double>(i);
    if (shape == PathShape::kWavy) {
      heading += block_length * (0.12 * std::sin(s / 7.0) + 0.02);
    } else {
      heading = (i % 2 == 0 ? 0.25 : -0.25) * std::numbers::pi;
    }
    x += block_length * std::cos(heading);
    y += block_length * std::sin(heading);
    fmt::print(file, "X{:.4f} Y{:.4f}\n", x, y);
  }
  fmt::print(file, "M30\n");
  std::fclose(file);
}

WavyFile::~WavyFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace twin::bench
