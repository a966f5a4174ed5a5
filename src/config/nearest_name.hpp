#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace twin::config {

/// Least number of insertions, deletions, replacements and swaps of neighbours that make one text
/// the other (restricted Damerau-Levenshtein distance), upper and lower case alike.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance, or an empty text when none is close enough to be
/// meant: more than a third of the letters would have to change.
std::string nearest_name(std::string_view wanted, std::span<const std::string> candidates);

/// "; did you mean X?" or nothing.
std::string did_you_mean(std::string_view wanted, std::span<const std::string> candidates);

}  // namespace twin::config
