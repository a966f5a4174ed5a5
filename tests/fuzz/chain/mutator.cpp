#include <algorithm>
#include <cstring>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/chain/chain_case.hpp"

// Changes of a case that keep what the rest of its bytes means: a byte that is removed anywhere else gives every byte
// behind it another meaning. The bytes are parts: settings, operations, and the stretches of the program.

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace twin::fuzz {
namespace {

using Part = std::vector<std::uint8_t>;
constexpr std::size_t kFirstStretch = 2;  // parts before it: settings, operations

std::vector<Part> parts_of(Bytes bytes) {
  std::vector<std::size_t> cuts = make_case(bytes).cuts;
  cuts.push_back(bytes.size());
  std::vector<Part> parts;
  std::size_t from = 0;
  for (const std::size_t cut : cuts) {
    const auto part = bytes.subspan(from, cut - from);
    parts.emplace_back(part.begin(), part.end());
    from = cut;
  }
  return parts;
}

/// Joins parts again. @returns the number of bytes, at most `most`
std::size_t join(const std::vector<Part>& parts, std::uint8_t* out, std::size_t most) {
  std::size_t size = 0;
  for (const Part& part : parts) {
    const std::size_t count = std::min(part.size(), most - size);
    std::copy_n(part.begin(), count, out + size);
    size += count;
  }
  return size;
}

/// Changes bytes of one part, whose length stays.
void change(Part& part) {
  if (!part.empty()) {
    const Part before = part;
    part.resize(std::max<std::size_t>(LLVMFuzzerMutate(part.data(), part.size(), part.size()), 1));
    std::copy(before.begin() + static_cast<std::ptrdiff_t>(part.size()), before.end(),
              std::back_inserter(part));
  }
}

/// Removes, doubles or exchanges stretches, or changes one part.
void rearrange(std::vector<Part>& parts, std::minstd_rand& random) {
  const auto any = [&](std::size_t count) { return random() / 7 % count; };
  const std::size_t stretches = parts.size() - kFirstStretch;
  const auto at = [&](std::size_t i) {
    return parts.begin() + static_cast<std::ptrdiff_t>(kFirstStretch + i);
  };
  switch (stretches > 0 ? any(8) : 7) {
    case 0:
      parts.erase(at(any(stretches)));
      break;
    case 1: {
      Part copy = *at(any(stretches));
      parts.insert(at(any(stretches + 1)), std::move(copy));
      break;
    }
    case 2:
      std::iter_swap(at(any(stretches)), at(any(stretches)));
      break;
    case 3:
      change(parts[0]);
      break;
    case 4:
      change(parts[1]);
      break;
    default:
      change(parts[any(parts.size())]);
  }
}

}  // namespace
}  // namespace twin::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace twin::fuzz;
  std::minstd_rand random(seed);
  if (size == 0 || random() / 7 % 4 == 0) {
    return LLVMFuzzerMutate(data, size, most);
  }
  std::vector<Part> parts = parts_of({data, size});
  rearrange(parts, random);
  const std::size_t length = join(parts, data, most);
  return length > 0 ? length : LLVMFuzzerMutate(data, 0, most);
}

/// Settings and operations of one case, the program of another; or some stretches of both.
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t size_of_one,
                                                 const std::uint8_t* other,
                                                 std::size_t size_of_other, std::uint8_t* out,
                                                 std::size_t most, unsigned seed) {
  using namespace twin::fuzz;
  std::minstd_rand random(seed);
  std::vector<Part> parts = parts_of({one, size_of_one});
  const std::vector<Part> others = parts_of({other, size_of_other});
  const std::size_t kept = kFirstStretch + random() / 7 % (parts.size() - kFirstStretch + 1);
  const std::size_t skipped = kFirstStretch + random() / 7 % (others.size() - kFirstStretch + 1);
  parts.resize(kept);
  parts.insert(parts.end(), others.begin() + static_cast<std::ptrdiff_t>(skipped), others.end());
  return join(parts, out, most);
}
