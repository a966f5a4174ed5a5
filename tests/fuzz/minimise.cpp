#include "tests/fuzz/minimise.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace {

bool still_says(const std::vector<std::uint8_t>& bytes, std::string_view text) {
  try {
    kChain.run(bytes);
  } catch (const Finding& finding) {
    return std::string_view(finding.what()).find(text) != std::string_view::npos;
  }
  return false;
}

/// Tries a change of every stretch of a length. @returns whether any was kept
template <class Change>
bool try_all(std::vector<std::uint8_t>& bytes, std::size_t length, std::string_view text,
             const Change& change) {
  bool has_changed = false;
  for (std::size_t at = 0; at + length <= bytes.size();) {
    auto tried = bytes;
    change(tried, at, length);
    if (tried != bytes && still_says(tried, text)) {
      bytes = std::move(tried);
      has_changed = true;
    } else {
      at += length;
    }
  }
  return has_changed;
}

}  // namespace

std::vector<std::uint8_t> minimise(std::vector<std::uint8_t> bytes, std::string_view text) {
  const auto at = [](std::vector<std::uint8_t>& all, std::size_t place) {
    return all.begin() + static_cast<std::ptrdiff_t>(place);
  };
  const auto remove = [&](std::vector<std::uint8_t>& all, std::size_t from, std::size_t length) {
    all.erase(at(all, from), at(all, from + length));
  };
  const auto clear = [&](std::vector<std::uint8_t>& all, std::size_t from, std::size_t length) {
    std::fill(at(all, from), at(all, from + length), std::uint8_t{0});
  };
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const std::size_t length : {64, 32, 16, 8, 4, 3, 2, 1}) {
      has_changed = try_all(bytes, length, text, remove) || has_changed;
    }
    for (const std::size_t length : {8, 4, 2, 1}) {
      has_changed = try_all(bytes, length, text, clear) || has_changed;
    }
  }
  return bytes;
}

}  // namespace twin::fuzz
