#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "gcode/reader_options.hpp"
#include "gcode/values/parameter_source.hpp"

namespace twin::gcode {

/// FANUC's null, the value of what was never set.
inline constexpr double kNullValue = std::numeric_limits<double>::quiet_NaN();
inline bool is_null(double value) noexcept { return std::isnan(value); }
inline double or_zero(double value) noexcept { return is_null(value) ? 0.0 : value; }

/// The variables of a program: #1 to #5602 by number, #<name> by name.
///
/// Numbers 1 to 30 and names without _ at their front belong to the subroutine that runs; names
/// that begin with _ and all other numbers belong to the whole program. Those that the control
/// keeps by itself are asked of a ParameterSource. A number that was never set is 0; a name that
/// was never set is an error. What a line sets takes effect behind the line: set_later(), commit().
///
/// In FANUC's dialect a number below 1000 that was never set is null, as #0 always is: neither equal
/// to 0 nor a word's value, and 0 in a sum; numbers 1 to 33 belong to the macro that G65 runs.
///
/// Names such as #<_hal[..]> and #<_ini[..]> are pins and settings of the very machine that LinuxCNC
/// runs. They have the values given to set_global(); without one they are 0 where nothing moves by
/// them (allow_unknown()), and an error elsewhere.
class Parameters {
 public:
  static constexpr int kMost = 5602;                ///< largest number
  static constexpr int kLocal = 30;                 ///< 1 to this belong to a subroutine
  static constexpr int kMacroLocal = 33;            ///< 1 to this belong to a macro of G65
  static constexpr int kNull = 1000;                ///< below this FANUC's may be null
  static constexpr int kSupplied = 5000;            ///< from here on the source is asked first
  static constexpr std::size_t kMostNames = 10000;  ///< that a program may make

  /// @param source  may be null; must outlive this object
  /// @param dialect  what functions and operators mean; not kAuto
  Parameters(ParameterSource* source, Dialect dialect);

  Dialect dialect() const noexcept { return dialect_; }

  /// Value of a number. @param column  for the error of a number that does not exist
  Expected<double> numbered(double number, int column) const;

  /// Value of a name as it stands between < and >: blanks and case do not matter.
  Expected<double> named(std::string_view name, int column) const;
  bool exists(std::string_view name) const;
  /// Whether a parameter of a number may be used.
  static bool exists(double number) noexcept;

  /// Whether what only the machine of LinuxCNC knows may be 0.
  void allow_unknown(bool is_allowed) noexcept { is_unknown_allowed_ = is_allowed; }
  /// The last name that was taken as 0 for that, once; else empty.
  std::string take_unknown() { return std::exchange(unknown_, {}); }
  bool has_unknown() const noexcept { return !unknown_.empty(); }

  /// Keeps a value until commit().
  Expected<void> set_later(double number, double value, int column);
  Expected<void> set_later(std::string_view name, double value, int column);
  /// Puts all values into force that were kept; what `numbered` and `named` give changes only here.
  void commit();
  /// Forgets what was kept.
  void drop() noexcept { kept_ = 0; }
  bool has_kept() const noexcept { return kept_ > 0; }

  /// Sets a name of the whole program at once, as "_value".
  void set_global(std::string_view name, double value);
  /// Sets what the user gives: a text such as "#100 = 5, _hal[torch.feed] = 1200".
  /// @returns an error that says what of it is no parameter or no number
  Expected<void> set_given(std::string_view text);

  /// Begins a subroutine: its #1 and so on are the arguments, further ones those of the caller.
  void enter(std::span<const double> arguments);
  /// Begins a macro of G65: its #1 to #33 are the arguments or null.
  void enter_macro(const std::array<double, kMacroLocal>& arguments);
  /// Ends it: #1 to #30 (#33) and the names of the caller are in force again.
  void leave();
  std::size_t depth() const noexcept { return scopes_.size(); }  ///< subroutines begun

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const noexcept {
      return std::hash<std::string_view>{}(text);
    }
  };
  using Names = std::unordered_map<std::string, double, Hash, std::equal_to<>>;
  struct Scope {
    std::array<double, kMacroLocal> numbers;
    Names names;
  };
  struct Kept {
    int number = 0;  // 0: by name
    std::string name;
    double value = 0.0;
  };

  Expected<int> index_of(double number, int column) const;
  std::string_view normal(std::string_view name) const;
  const double* find(std::string_view normal_name) const;
  Kept& keep();
  void set_named(const std::string& name, double value);

  ParameterSource* source_;
  Dialect dialect_;
  std::vector<double> numbers_;
  Names globals_;
  Names locals_;
  std::vector<Scope> scopes_;  // of the callers
  std::vector<Kept> kept_values_;
  std::size_t kept_ = 0;  // of kept_values_, whose strings are used again
  mutable std::string scratch_;
  mutable std::string unknown_;
  bool is_unknown_allowed_ = false;
};

}  // namespace twin::gcode
