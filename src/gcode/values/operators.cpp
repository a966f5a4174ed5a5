#include "gcode/values/operators.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

constexpr double kAlmostEqual = 1e-6;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLargestInteger = 9007199254740992.0;  // 2^53

struct NamedOperator {
  std::string_view name;
  Operator op;
};

constexpr std::array kNamedOperators = {
    NamedOperator{"MOD", Operator::kModulo},
    NamedOperator{"EQ", Operator::kEqual},
    NamedOperator{"NE", Operator::kNotEqual},
    NamedOperator{"GT", Operator::kGreater},
    NamedOperator{"GE", Operator::kGreaterOrEqual},
    NamedOperator{"LT", Operator::kLess},
    NamedOperator{"LE", Operator::kLessOrEqual},
    NamedOperator{"AND", Operator::kAnd},
    NamedOperator{"OR", Operator::kOr},
    NamedOperator{"XOR", Operator::kXor},
};

/// Steps over a word whatever its case and the blanks in it.
bool step_over(std::string_view line, std::size_t& at, std::string_view word) noexcept {
  std::size_t place = at;
  for (const char c : word) {
    skip_blanks(line, place);
    if (upper(at_or_zero(line, place)) != c) {
      return false;
    }
    ++place;
  }
  at = place;
  return true;
}

double truth(bool is_true) noexcept { return is_true ? 1.0 : 0.0; }

double modulo(double left, double right) noexcept {
  const double rest = std::fmod(left, right);
  return rest < 0.0 ? rest + std::abs(right) : rest;
}

bool is_whole(double x) noexcept { return x == std::floor(x) && std::abs(x) <= kLargestInteger; }

double logic(Operator op, double left, double right, Dialect dialect) noexcept {
  if (dialect == Dialect::kFanuc && is_whole(left) && is_whole(right)) {
    const auto a = static_cast<std::int64_t>(left);
    const auto b = static_cast<std::int64_t>(right);
    return static_cast<double>(op == Operator::kAnd ? a & b : op == Operator::kOr ? a | b : a ^ b);
  }
  const bool a = left != 0.0;
  const bool b = right != 0.0;
  return truth(op == Operator::kAnd ? a && b : op == Operator::kOr ? a || b : a != b);
}

double compared(Operator op, double left, double right) noexcept {
  switch (op) {
    case Operator::kEqual:
      return truth(std::abs(left - right) < kAlmostEqual);
    case Operator::kNotEqual:
      return truth(!(std::abs(left - right) < kAlmostEqual));
    case Operator::kGreater:
      return truth(left > right);
    case Operator::kGreaterOrEqual:
      return truth(left >= right);
    case Operator::kLess:
      return truth(left < right);
    default:
      return truth(left <= right);
  }
}

double applied(Operator op, double left, double right, Dialect dialect) noexcept {
  switch (op) {
    case Operator::kPower:
      return std::pow(left, right);
    case Operator::kTimes:
      return left * right;
    case Operator::kOver:
      return left / right;
    case Operator::kModulo:
      return modulo(left, right);
    case Operator::kPlus:
      return left + right;
    case Operator::kMinus:
      return left - right;
    case Operator::kAnd:
    case Operator::kOr:
    case Operator::kXor:
      return logic(op, left, right, dialect);
    default:
      return compared(op, left, right);
  }
}

/// Rounds to a whole number: FIX down, FUP up; in FANUC's dialect towards zero and away from it.
double rounded_to_whole(double x, bool is_up, Dialect dialect) noexcept {
  const bool is_mirrored = dialect == Dialect::kFanuc && x < 0.0;
  return is_up != is_mirrored ? std::ceil(x) : std::floor(x);
}

struct Function {
  std::string_view name;
  double (*value)(double x, Dialect dialect);
};

constexpr std::array kFunctions = {
    Function{"ABS", [](double x, Dialect) { return std::abs(x); }},
    Function{"ACOS", [](double x, Dialect) { return std::acos(x) / kDegree; }},
    Function{"ASIN", [](double x, Dialect) { return std::asin(x) / kDegree; }},
    Function{"COS", [](double x, Dialect) { return std::cos(x * kDegree); }},
    Function{"EXP", [](double x, Dialect) { return std::exp(x); }},
    Function{"FIX", [](double x, Dialect dialect) { return rounded_to_whole(x, false, dialect); }},
    Function{"FUP", [](double x, Dialect dialect) { return rounded_to_whole(x, true, dialect); }},
    Function{"ROUND", [](double x, Dialect) { return std::round(x); }},
    Function{"LN", [](double x, Dialect) { return std::log(x); }},
    Function{"SIN", [](double x, Dialect) { return std::sin(x * kDegree); }},
    Function{"SQRT", [](double x, Dialect) { return std::sqrt(x); }},
    Function{"TAN", [](double x, Dialect) { return std::tan(x * kDegree); }},
    Function{"RND", [](double x, Dialect) { return std::round(x); }},
    Function{"SQR", [](double x, Dialect) { return std::sqrt(x); }},
};

}  // namespace

int strength(Operator op) noexcept {
  switch (op) {
    case Operator::kNone:
      return 0;
    case Operator::kPower:
      return 5;
    case Operator::kTimes:
    case Operator::kOver:
    case Operator::kModulo:
      return 4;
    case Operator::kPlus:
    case Operator::kMinus:
      return 3;
    case Operator::kAnd:
    case Operator::kOr:
    case Operator::kXor:
      return 1;
    default:
      return 2;
  }
}

Operator read_operator(std::string_view line, std::size_t& at) noexcept {
  switch (at_or_zero(line, at)) {
    case '+':
      ++at;
      return Operator::kPlus;
    case '-':
      ++at;
      return Operator::kMinus;
    case '/':
      ++at;
      return Operator::kOver;
    case '*':
      ++at;
      return step_over(line, at, "*") ? Operator::kPower : Operator::kTimes;
    default:
      break;
  }
  for (const NamedOperator& named : kNamedOperators) {
    if (step_over(line, at, named.name)) {
      return named.op;
    }
  }
  return Operator::kNone;
}

Expected<double> apply(Operator op, double left, double right, Dialect dialect, int column) {
  if ((op == Operator::kOver || op == Operator::kModulo) && right == 0.0) {
    return fail_at(column, fmt::format("{:.10g} is divided by zero", left));
  }
  const double value = applied(op, left, right, dialect);
  if (!std::isfinite(value)) {
    return fail_at(
        column,
        fmt::format("the operation on {:.10g} and {:.10g} gives no finite number", left, right));
  }
  return value;
}

Expected<double> apply_function(std::string_view name, double argument, Dialect dialect,
                                int column) {
  for (const Function& function : kFunctions) {
    if (function.name == name) {
      const double value = function.value(argument, dialect);
      if (!std::isfinite(value)) {
        return fail_at(column, fmt::format("{}[{:.10g}] is no finite number", name, argument));
      }
      return value;
    }
  }
  return fail_at(column, fmt::format("'{}' is no function: expected ABS, ACOS, ASIN, ATAN, COS, "
                                     "EXISTS, EXP, FIX, FUP, LN, ROUND, SIN, SQRT or TAN",
                                     name));
}

double arc_tangent(double y, double x, Dialect dialect) noexcept {
  const double angle = std::atan2(y, x) / kDegree;
  return dialect == Dialect::kFanuc && angle < 0.0 ? angle + 360.0 : angle;
}

}  // namespace twin::gcode
