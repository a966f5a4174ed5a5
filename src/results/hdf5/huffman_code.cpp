#include "results/hdf5/huffman_code.hpp"

#include <algorithm>
#include <vector>

namespace twin::results::hdf5 {
namespace {

std::vector<std::uint16_t> sorted_leaves(const SymbolCounts& counts) {
  std::vector<std::uint16_t> leaves;
  for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
    if (counts[symbol] > 0) {
      leaves.push_back(static_cast<std::uint16_t>(symbol));
    }
  }
  std::stable_sort(leaves.begin(), leaves.end(),
                   [&counts](std::uint16_t a, std::uint16_t b) { return counts[a] < counts[b]; });
  return leaves;
}

/// Lengths of the code for these counts, however long: leaves in the order of their counts, and inner
/// nodes in the order in which they are made, are two queues, of which the lesser heads are joined.
/// @returns the longest one
unsigned find_lengths(const SymbolCounts& counts, HuffmanCode& code) {
  const std::vector<std::uint16_t> leaves = sorted_leaves(counts);
  std::vector<std::uint64_t> weights;  // of the leaves, then of inner nodes
  for (const std::uint16_t leaf : leaves) {
    weights.push_back(counts[leaf]);
  }
  std::vector<std::size_t> parents(2 * leaves.size() - 1);
  std::size_t leaf = 0;
  std::size_t node = leaves.size();
  const auto take_least = [&] {
    const bool is_leaf =
        leaf < leaves.size() && (node >= weights.size() || weights[leaf] <= weights[node]);
    return is_leaf ? leaf++ : node++;
  };
  while (weights.size() < parents.size()) {
    const std::size_t a = take_least();
    const std::size_t b = take_least();
    parents[a] = parents[b] = weights.size();
    weights.push_back(weights[a] + weights[b]);
  }
  std::vector<unsigned> depths(parents.size());  // the last node is the root
  for (std::size_t i = parents.size() - 1; i-- > 0;) {
    depths[i] = depths[parents[i]] + 1;
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    code.lengths[leaves[i]] = static_cast<std::uint8_t>(depths[i]);
  }
  return depths.front();  // the rarest leaf lies deepest
}

/// Numbers the codes of each length in the order of their symbols.
void number(HuffmanCode& code) {
  std::array<unsigned, kLongestCode + 2> next{};
  for (const std::uint8_t length : code.lengths) {
    next[length + 1U] += length > 0 ? 1U : 0U;
  }
  for (std::size_t length = 1; length < next.size(); ++length) {
    next[length] = 2 * (next[length - 1] + next[length]);
  }
  for (std::size_t symbol = 0; symbol < kCodedSymbols; ++symbol) {
    const unsigned length = code.lengths[symbol];
    unsigned value = length > 0 ? next[length]++ : 0U;
    unsigned reversed = 0;  // a code goes first bit first
    for (unsigned i = 0; i < length; ++i, value >>= 1U) {
      reversed = (reversed << 1U) | (value & 1U);
    }
    code.bits[symbol] = static_cast<std::uint16_t>(reversed);
  }
}

}  // namespace

HuffmanCode make_huffman_code(SymbolCounts counts) {
  HuffmanCode code;
  while (find_lengths(counts, code) > kLongestCode) {
    for (std::uint32_t& count : counts) {
      count = (count + 1) / 2;
    }
  }
  number(code);
  return code;
}

}  // namespace twin::results::hdf5
