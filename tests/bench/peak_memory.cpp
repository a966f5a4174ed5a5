#include "tests/bench/peak_memory.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace twin::bench {

void reset_peak_memory() {
  ::malloc_trim(0);  // what earlier benchmarks left
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmHWM:") {
      std::int64_t kib = 0;
      status >> kib;
      return 1024 * kib;
    }
  }
  return 0;
}

}  // namespace twin::bench
