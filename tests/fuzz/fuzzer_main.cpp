#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/target.hpp"

// The entry of libFuzzer for one target, which the build names: TWIN_FUZZ_TARGET.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const twin::fuzz::Target& target = twin::fuzz::TWIN_FUZZ_TARGET;
  const twin::fuzz::Bytes bytes(data, size);
  if (std::getenv("TWIN_FUZZ_SHOW") != nullptr) {
    const std::string text =
        target.show != nullptr ? target.show(bytes) : std::string(twin::fuzz::text_of(bytes));
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  }
  try {
    target.run(bytes);
  } catch (const twin::fuzz::Finding& finding) {
    const std::string what = target.show != nullptr ? target.show(bytes) : std::string();
    std::fprintf(stderr, "FINDING: %s\n%s", finding.what(), what.c_str());
    std::abort();
  }
  return 0;
}
