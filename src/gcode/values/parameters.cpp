#include "gcode/values/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/values/number.hpp"

namespace twin::gcode {
namespace {

constexpr double kNearWhole = 1e-4;  // how far a parameter's number may be off a whole one

bool is_global(std::string_view name) { return name.starts_with('_'); }

/// True for the name of a pin or of a setting of LinuxCNC's machine.
bool is_of_machine(std::string_view name) {
  return name.starts_with("_hal[") || name.starts_with("_ini[");
}

constexpr std::string_view kBlanksAround = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanksAround);
  return begin == std::string_view::npos
             ? std::string_view()
             : text.substr(begin, text.find_last_not_of(kBlanksAround) - begin + 1);
}

}  // namespace

Parameters::Parameters(ParameterSource* source, Dialect dialect)
    : source_(source), dialect_(dialect), numbers_(kMost + 1, 0.0) {
  if (dialect == Dialect::kFanuc) {
    std::fill_n(numbers_.begin(), kNull, kNullValue);
  }
}

bool Parameters::exists(double number) noexcept {
  const double whole = std::round(number);
  return std::abs(number - whole) < kNearWhole && whole >= 1.0 && whole <= kMost;
}

Expected<int> Parameters::index_of(double number, int column) const {
  const double whole = std::round(number);
  if (whole == 0.0 && dialect_ == Dialect::kFanuc) {
    return 0;
  }
  if (!exists(number)) {
    return fail_at(column,
                   fmt::format("#{:.10g}: expected a parameter from #1 to #{}", number, kMost));
  }
  return static_cast<int>(whole);
}

Expected<double> Parameters::numbered(double number, int column) const {
  TWIN_TRY(const int index, index_of(number, column));
  if (index >= kSupplied && source_ != nullptr) {
    if (const auto supplied = source_->numbered(index)) {
      return *supplied;
    }
  }
  return numbers_[static_cast<std::size_t>(index)];
}

/// The name in lower case without blanks; valid until the next call.
std::string_view Parameters::normal(std::string_view name) const {
  const auto is_odd = [](char c) { return is_blank(c) || (c >= 'A' && c <= 'Z'); };
  if (std::none_of(name.begin(), name.end(), is_odd)) {
    return name;
  }
  scratch_.clear();
  for (const char c : name) {
    if (!is_blank(c)) {
      scratch_.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
    }
  }
  return scratch_;
}

const double* Parameters::find(std::string_view normal_name) const {
  const Names& names = is_global(normal_name) ? globals_ : locals_;
  const auto found = names.find(normal_name);
  return found == names.end() ? nullptr : &found->second;
}

Expected<double> Parameters::named(std::string_view name, int column) const {
  const std::string_view key = normal(name);
  if (const double* value = find(key)) {
    return *value;
  }
  if (source_ != nullptr && is_global(key)) {
    if (const auto supplied = source_->named(key)) {
      return *supplied;
    }
  }
  if (is_of_machine(key)) {
    if (is_unknown_allowed_) {
      unknown_ = key;
      return 0.0;
    }
    return fail_at(column, fmt::format("#<{}> is known to LinuxCNC's machine alone: expected its "
                                       "value in the setting program.parameters",
                                       key));
  }
  return fail_at(column, fmt::format("#<{}> has no value: expected a line that sets it before this "
                                     "one",
                                     key));
}

bool Parameters::exists(std::string_view name) const {
  const std::string_view key = normal(name);
  return find(key) != nullptr ||
         (source_ != nullptr && is_global(key) && source_->named(key).has_value());
}

Parameters::Kept& Parameters::keep() {
  if (kept_ == kept_values_.size()) {
    kept_values_.emplace_back();
  }
  return kept_values_[kept_++];
}

Expected<void> Parameters::set_later(double number, double value, int column) {
  TWIN_TRY(const int index, index_of(number, column));
  if (index == 0) {
    return fail_at(column, "#0 is always null: expected a parameter from #1 on");
  }
  Kept& kept = keep();
  kept.number = index;
  kept.value = value;
  return {};
}

Expected<void> Parameters::set_later(std::string_view name, double value, int column) {
  const std::string_view key = normal(name);
  if (source_ != nullptr && is_global(key) && source_->named(key)) {
    return fail_at(column,
                   fmt::format("#<{}> belongs to the control: expected a name of your own", key));
  }
  if (find(key) == nullptr && globals_.size() + locals_.size() >= kMostNames) {
    return fail_at(column,
                   fmt::format("#<{}> is one name too many: expected at most {}", key, kMostNames));
  }
  Kept& kept = keep();
  kept.number = 0;
  kept.name.assign(key);
  kept.value = value;
  return {};
}

void Parameters::commit() {
  for (std::size_t i = 0; i < kept_; ++i) {
    const Kept& kept = kept_values_[i];
    if (kept.number == 0) {
      set_named(kept.name, kept.value);
    } else if (kept.number < kSupplied || source_ == nullptr ||
               !source_->set(kept.number, kept.value)) {
      numbers_[static_cast<std::size_t>(kept.number)] = kept.value;
    }
  }
  kept_ = 0;
}

void Parameters::set_named(const std::string& name, double value) {
  Names& names = is_global(name) ? globals_ : locals_;
  const auto found = names.find(name);
  if (found != names.end()) {
    found->second = value;
  } else {
    names.emplace(name, value);
  }
}

void Parameters::set_global(std::string_view name, double value) {
  set_named(std::string(name), value);
}

Expected<void> Parameters::set_given(std::string_view text) {
  while (!trimmed(text).empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view item = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t sign = item.rfind('=');
    std::string_view name = trimmed(item.substr(0, std::min(sign, item.size())));
    name.remove_prefix(name.starts_with('#') ? 1 : 0);
    const std::string_view given =
        sign == std::string_view::npos ? item : trimmed(item.substr(sign + 1));
    const Number value = parse_number(given);
    if (value.status != NumberStatus::kOk || value.length != given.size() || name.empty()) {
      return fail_at(0, fmt::format("program.parameters has '{}': expected #NUMBER=VALUE or "
                                    "NAME=VALUE",
                                    trimmed(item)));
    }
    const Number number = parse_number(name);
    if (number.status == NumberStatus::kOk && number.length == name.size()) {
      TWIN_CHECK(set_later(number.value, value.value, 0));
    } else {
      name.remove_prefix(name.starts_with('<') ? 1 : 0);
      name.remove_suffix(name.ends_with('>') ? 1 : 0);
      TWIN_CHECK(set_later(name, value.value, 0));
    }
  }
  commit();
  return {};
}

void Parameters::enter_macro(const std::array<double, kMacroLocal>& arguments) {
  enter({});
  std::copy(arguments.begin(), arguments.end(), numbers_.begin() + 1);
}

void Parameters::enter(std::span<const double> arguments) {
  Scope& scope = scopes_.emplace_back();
  std::copy_n(numbers_.begin() + 1, kMacroLocal, scope.numbers.begin());
  scope.names.swap(locals_);
  std::copy(arguments.begin(), arguments.end(), numbers_.begin() + 1);
}

void Parameters::leave() {
  Scope& scope = scopes_.back();
  const int locals = dialect_ == Dialect::kFanuc ? kMacroLocal : kLocal;
  std::copy_n(scope.numbers.begin(), locals, numbers_.begin() + 1);
  locals_ = std::move(scope.names);
  scopes_.pop_back();
}

}  // namespace twin::gcode
