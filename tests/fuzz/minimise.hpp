#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace twin::fuzz {

/// Removes bytes, and sets bytes to 0, as long as the chain still has a finding that says the same.
/// @param text  part of the finding's message
std::vector<std::uint8_t> minimise(std::vector<std::uint8_t> bytes, std::string_view text);

}  // namespace twin::fuzz
