#include "tests/fuzz/chain/known_defects.hpp"
#include "tests/fuzz/chain/outcome.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace chain_target {

/// Longer strings of bytes are longer programs, which find nothing that short ones do not.
constexpr std::size_t kMostBytes = 600;

Case case_of(Bytes bytes) {
  Case made = make_case(bytes.first(std::min(bytes.size(), kMostBytes)));
  return made;
}

void run(Bytes bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) {
    sum += byte;
  }
  const Outcome outcome = examine(case_of(bytes), sum % 16 == 0);
  std::string all;
  for (const Breach& finding : outcome.findings) {
    all += (all.empty() ? "" : "; ") + to_string(finding);
  }
  promise(all.empty(), all);
}

std::string show(Bytes bytes) { return fuzz::show(case_of(bytes)); }

}  // namespace chain_target

const Target kChain{"chain", chain_target::run, chain_target::show};

}  // namespace twin::fuzz
