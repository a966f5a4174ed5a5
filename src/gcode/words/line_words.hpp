#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"
#include "gcode/text/comment.hpp"
#include "gcode/words/codes.hpp"

namespace twin::gcode {

class Parameters;
struct Word;

/// The words of one line, sorted by what they are; one object serves line after line.
///
/// A letter has one word at most on a line, and so has each modal group of G and of M words.
class LineWords {
 public:
  /// @param ignored  letters whose words are left out and only counted
  explicit LineWords(std::string_view ignored = "");

  /// Reads the words of a line, which replace those of the line before.
  ///
  /// @param parameters  give the values that are computed, and keep those that the line sets
  /// @returns an error with its column for a word that no line may have
  Expected<void> read(std::string_view line, Parameters& parameters);

  /// Reads what can be read of a line that read() has refused.
  /// @returns false if a word was left out that may have been of X, Y or Z
  bool read_leniently(std::string_view line, Parameters& parameters);

  /// The last comment of the line without its parentheses; valid as long as the line's text.
  std::string_view comment() const noexcept { return comment_; }
  CommentOddity oddity() const noexcept { return oddity_; }
  /// True if a word of this letter was left out of the line.
  bool has_left_out(char letter) const noexcept { return (left_out_ & bit(index(letter))) != 0; }
  /// True if any word was left out, so that a line may name no axis that is there.
  bool has_left_out() const noexcept { return left_out_ != 0; }
  /// True if the line has a comment, or had words left out.
  bool is_unusual() const noexcept { return !comment_.empty() || left_out_ != 0; }

  /// Takes a word out of the line.
  void remove(char letter) noexcept { letters_ &= ~bit(index(letter)); }
  /// Puts a word into the line, in place of the one that it has.
  void set(char letter, double value, int column) noexcept {
    letters_ |= bit(index(letter));
    value_[index(letter)] = value;
    column_[index(letter)] = column;
  }
  /// Gives the word of a group another meaning; only if has(group).
  void set(GGroup group, GWord word) noexcept { g_[index(group)] = word; }
  /// Gives a word another number; only if has(letter).
  void set_value(char letter, double value) noexcept { value_[index(letter)] = value; }
  /// Makes one word another.
  void rename(char from, char to) noexcept {
    letters_ = (letters_ & ~bit(index(from))) | bit(index(to));
    value_[index(to)] = value_[index(from)];
    column_[index(to)] = column_[index(from)];
  }
  void remove(MGroup group) noexcept { m_groups_ &= ~bit(index(group)); }
  void remove(GGroup group) noexcept { g_groups_ &= ~bit(index(group)); }
  /// True if the line has a G word of another group than this.
  bool has_other_than(GGroup group) const noexcept { return (g_groups_ & ~bit(index(group))) != 0; }
  /// True if the P word is written with a decimal point.
  bool has_point_in_p() const noexcept { return has_point_in_p_; }

  bool is_empty() const noexcept { return letters_ == 0 && g_groups_ == 0 && m_groups_ == 0; }
  bool has(char letter) const noexcept { return (letters_ & bit(index(letter))) != 0; }
  bool has(GGroup group) const noexcept { return (g_groups_ & bit(index(group))) != 0; }
  bool has(MGroup group) const noexcept { return (m_groups_ & bit(index(group))) != 0; }
  bool has(GGroup group, GWord word) const noexcept { return has(group) && g(group) == word; }
  bool has(MGroup group, MWord word) const noexcept { return has(group) && m(group) == word; }

  bool has_m() const noexcept { return m_groups_ != 0; }

  /// A set of letters, a bit for each.
  static constexpr std::uint32_t set_of(std::string_view letters) noexcept {
    std::uint32_t set = 0;
    for (const char letter : letters) {
      set |= bit(index(letter));
    }
    return set;
  }
  /// The letters of the line, G and M aside.
  std::uint32_t letters() const noexcept { return letters_; }

  /// A set of groups of G words, a bit for each.
  template <class... Groups>
  static constexpr std::uint32_t groups_of(Groups... groups) noexcept {
    return (bit(index(groups)) | ...);
  }
  std::uint32_t g_groups() const noexcept { return g_groups_; }

  /// True if the line has one of these letters, each from 'A' to kPolarAngle.
  bool has_any(std::string_view letters) const noexcept {
    return (letters_ & set_of(letters)) != 0;
  }

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
  /// Column of the leftmost G word, or 0.
  int first_g_column() const noexcept;
  double g_number(GGroup group) const noexcept { return g_number_[index(group)]; }

  /// The M word of a group; only if has(group).
  MWord m(MGroup group) const noexcept { return m_[index(group)]; }
  int column(MGroup group) const noexcept { return m_column_[index(group)]; }
  double m_number(MGroup group) const noexcept { return m_number_[index(group)]; }

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

  bool is_plain(const Word& word) const noexcept;
  Expected<void> add(const Word& word);
  Expected<void> add_argument(const Word& word);
  Expected<void> add_g(const Word& word);
  Expected<void> add_m(const Word& word);

  std::uint32_t ignored_ = 0;
  std::uint32_t left_out_ = 0;
  std::uint32_t letters_ = 0;
  std::uint32_t g_groups_ = 0;
  std::uint32_t m_groups_ = 0;
  std::array<double, kLetters> value_{};
  std::array<int, kLetters> column_{};
  std::array<GWord, kGGroups> g_{};
  std::array<double, kGGroups> g_number_{};
  std::array<int, kGGroups> g_column_{};
  std::array<MWord, kMGroups> m_{};
  std::array<double, kMGroups> m_number_{};
  std::array<int, kMGroups> m_column_{};
  std::string_view comment_;
  CommentOddity oddity_ = CommentOddity::kNone;
  bool has_point_in_p_ = false;
};

}  // namespace twin::gcode
