#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"
#include "gcode/codes.hpp"

namespace twin::gcode {

struct ModalState;
struct Word;

/// The words of one line, sorted by what they are; one object serves line after line.
///
/// A letter has one word at most on a line, and so has each modal group of G and of M words.
class LineWords {
 public:
  /// Reads the words of a line, which replace those of the line before.
  /// @returns an error with its column for a word that no line may have
  Expected<void> read(std::string_view line);

  bool is_empty() const noexcept { return letters_ == 0 && g_groups_ == 0 && m_groups_ == 0; }
  bool has(char letter) const noexcept { return (letters_ & bit(index(letter))) != 0; }
  bool has(GGroup group) const noexcept { return (g_groups_ & bit(index(group))) != 0; }
  bool has(MGroup group) const noexcept { return (m_groups_ & bit(index(group))) != 0; }
  bool has(GGroup group, GWord word) const noexcept { return has(group) && g(group) == word; }
  bool has(MGroup group, MWord word) const noexcept { return has(group) && m(group) == word; }

  bool has_m() const noexcept { return m_groups_ != 0; }

  /// True if the line has one of these letters, each from 'A' to 'Z'.
  bool has_any(std::string_view letters) const noexcept;

  /// Number of a letter's word in the program's units; only if has(letter).
  double value(char letter) const noexcept { return value_[index(letter)]; }

  /// Number of a letter's word, or 0 if the line has none.
  double value_or_zero(char letter) const noexcept { return has(letter) ? value(letter) : 0.0; }

  /// Column of a letter's word in bytes from 1; only if has(letter).
  int column(char letter) const noexcept { return column_[index(letter)]; }

  /// Column of the leftmost of these letters' words, or 0.
  int first_column(std::string_view letters) const noexcept;

  /// The G word of a group; only if has(group).
  GWord g(GGroup group) const noexcept { return g_[index(group)]; }
  int column(GGroup group) const noexcept { return g_column_[index(group)]; }

  /// The M word of a group; only if has(group).
  MWord m(MGroup group) const noexcept { return m_[index(group)]; }

 private:
  static constexpr std::size_t index(char letter) noexcept {
    return static_cast<std::size_t>(letter - 'A');
  }
  static constexpr std::size_t index(GGroup group) noexcept {
    return static_cast<std::size_t>(group);
  }
  static constexpr std::size_t index(MGroup group) noexcept {
    return static_cast<std::size_t>(group);
  }
  static constexpr std::uint32_t bit(std::size_t place) noexcept { return 1U << place; }

  Expected<void> add(const Word& word);
  Expected<void> add_g(const Word& word);
  Expected<void> add_m(const Word& word);

  std::uint32_t letters_ = 0;
  std::uint32_t g_groups_ = 0;
  std::uint32_t m_groups_ = 0;
  std::array<double, 26> value_{};
  std::array<int, 26> column_{};
  std::array<GWord, kGGroups> g_{};
  std::array<double, kGGroups> g_number_{};
  std::array<int, kGGroups> g_column_{};
  std::array<MWord, kMGroups> m_{};
  std::array<double, kMGroups> m_number_{};
};

/// Whether the words of a line belong together.
///
///   X Y Z    need a motion word in force, and no G04 beside them
///   I J K R  need G02 or G03; I J K only those of the plane, and not with R
///   P        needs G04 or G64, not both
///   G04      needs P
///   feed moves need a feedrate, arcs I J K or R
///
/// @param state  modal state with the line's own words in force
Expected<void> check_words(const LineWords& words, const ModalState& state);

/// True if the line asks for a move: axis words, or the centre of a full circle.
bool asks_for_move(const LineWords& words, const ModalState& state) noexcept;

}  // namespace twin::gcode
