#include "config/binding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "config/nearest_name.hpp"

namespace twin::config {
namespace {

std::string text_of(const Value& value) {
  struct Visitor {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return '"' + x + '"'; }
    std::string operator()(const std::vector<double>& x) const {
      return fmt::format("[{}]", fmt::join(x, ", "));
    }
  };
  return std::visit(Visitor{}, value);
}

tl::unexpected<Error> wrong_type(const Binding& b, const Value& value, std::string_view wanted) {
  return fail(ErrorCode::kUsage,
              fmt::format("{} = {} is not {}", b.path(), text_of(value), wanted));
}

Expected<double> number(const Binding& b, const Value& value, std::string_view wanted) {
  double x = 0.0;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    x = static_cast<double>(*whole);
  } else if (const auto* real = std::get_if<double>(&value)) {
    x = *real;
  } else {
    return wrong_type(b, value, wanted);
  }
  if (!std::isfinite(x)) {
    return wrong_type(b, value, "a finite number");
  }
  if (x < b.min || x > b.max) {
    const std::string unit = pretty_unit(b.unit);
    return fail(ErrorCode::kUsage, fmt::format("{} = {}{}{} is out of range: {}", b.path(), x,
                                               unit.empty() ? "" : " ", unit, range_text(b)));
  }
  return x;
}

// Gives a field of each kind its value.
struct Assign {
  const Binding& b;
  const Value& value;

  Expected<void> operator()(double* field) const {
    return number(b, value, "a number").map([&](double x) { *field = x / b.per_base; });
  }
  Expected<void> operator()(int* field) const {
    if (!std::holds_alternative<std::int64_t>(value)) {
      return wrong_type(b, value, "a whole number");
    }
    return number(b, value, "a whole number").map([&](double x) { *field = static_cast<int>(x); });
  }
  Expected<void> operator()(bool* field) const {
    const auto* flag = std::get_if<bool>(&value);
    if (flag == nullptr) {
      return wrong_type(b, value, "true or false");
    }
    *field = *flag;
    return {};
  }
  Expected<void> operator()(std::string* field) const {
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr || static_cast<double>(text->size()) < b.min) {
      return wrong_type(b, value, "a text");
    }
    *field = *text;
    return {};
  }
  Expected<void> operator()(const Choice& field) const {
    const auto* text = std::get_if<std::string>(&value);
    const auto name = text == nullptr ? field.names.end() : std::ranges::find(field.names, *text);
    if (name == field.names.end()) {
      const std::vector<std::string> names(field.names.begin(), field.names.end());
      return wrong_type(
          b, value,
          "one of " + range_text(b) + (text == nullptr ? "" : did_you_mean(*text, names)));
    }
    field.set(static_cast<std::size_t>(name - field.names.begin()));
    return {};
  }
  Expected<void> operator()(Vec3* field) const {
    const auto* list = std::get_if<std::vector<double>>(&value);
    if (list == nullptr || list->size() != 3) {
      return wrong_type(b, value, "a list of three numbers [x, y, z]");
    }
    Vec3 vector;
    for (std::size_t i = 0; i < 3; ++i) {
      TWIN_TRY(const double x, number(b, (*list)[i], "a number"));
      vector[static_cast<Eigen::Index>(i)] = x / b.per_base;
    }
    *field = vector;
    return {};
  }
};

// In the key's unit; 15 digits, so that 0.1 s in ms is 100 and not 100.00000000000001.
std::string scaled(double field, double per_base) {
  return fmt::format("{:.15g}", field * per_base);
}

std::string real_text(double field, double per_base) {
  const std::string text = scaled(field, per_base);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

const Binding* find_binding(const std::vector<Binding>& list, std::string_view section,
                            std::string_view name) {
  const auto found = std::ranges::find_if(list, [&](const Binding& b) {
    return (b.section == section && b.is_called(name)) ||
           (!b.former.empty() && b.former == fmt::format("{}.{}", section, name));
  });
  return found == list.end() ? nullptr : &*found;
}

std::string renaming_note(const Binding& binding, std::string_view section) {
  return section == binding.section
             ? ""
             : fmt::format("{} is now called {}", binding.former, binding.path());
}

Expected<void> assign(const Binding& binding, const Value& value) {
  return std::visit(Assign{binding, value}, binding.target);
}

Value setting_value(const Binding& binding) {
  struct Visitor {
    double per_base;
    double in_unit(double field) const {
      return std::strtod(scaled(field, per_base).c_str(), nullptr);
    }
    Value operator()(const double* x) const { return in_unit(*x); }
    Value operator()(const int* x) const { return std::int64_t{*x}; }
    Value operator()(const bool* x) const { return *x; }
    Value operator()(const std::string* x) const { return *x; }
    Value operator()(const Choice& x) const { return std::string(x.names[x.get()]); }
    Value operator()(const Vec3* x) const {
      return std::vector<double>{in_unit(x->x()), in_unit(x->y()), in_unit(x->z())};
    }
  };
  return std::visit(Visitor{binding.per_base}, binding.target);
}

std::string value_text(const Binding& binding) {
  struct Visitor {
    double per_base;
    std::string operator()(const double* x) const { return real_text(*x, per_base); }
    std::string operator()(const int* x) const { return std::to_string(*x); }
    std::string operator()(const bool* x) const { return *x ? "true" : "false"; }
    std::string operator()(const std::string* x) const { return '"' + *x + '"'; }
    std::string operator()(const Choice& x) const {
      return '"' + std::string(x.names[x.get()]) + '"';
    }
    std::string operator()(const Vec3* x) const {
      return fmt::format("[{}, {}, {}]", real_text(x->x(), per_base), real_text(x->y(), per_base),
                         real_text(x->z(), per_base));
    }
  };
  return std::visit(Visitor{binding.per_base}, binding.target);
}

std::string pretty_unit(std::string_view unit) {
  if (unit.starts_with("per_")) {
    return fmt::format("1/{}", unit.substr(4));
  }
  const auto per = unit.find("_per_");
  std::string text(unit.substr(0, per));
  if (per != std::string_view::npos) {
    text += '/';
    text += unit.substr(per + 5);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  if (text.size() > 1 && (text.back() == '2' || text.back() == '3')) {
    const char power = text.back();
    text.back() = '^';
    text += power;
  }
  return text;
}

std::string range_text(const Binding& binding) {
  if (const auto* named = std::get_if<Choice>(&binding.target)) {
    return fmt::format("{}", fmt::join(named->names, ", "));
  }
  if (std::holds_alternative<bool*>(binding.target)) {
    return "true, false";
  }
  if (std::holds_alternative<std::string*>(binding.target)) {
    return "";
  }
  const std::string unit = pretty_unit(binding.unit);
  return fmt::format("{:g} to {:g}{}{}", binding.min, binding.max, unit.empty() ? "" : " ", unit);
}

}  // namespace twin::config
