#include "gcode/values/expression.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "gcode/text/characters.hpp"
#include "gcode/text/fault.hpp"
#include "gcode/values/number.hpp"
#include "gcode/values/operators.hpp"
#include "gcode/values/parameters.hpp"

namespace twin::gcode {
namespace {

constexpr int kDeepest = 50;  // brackets within brackets
constexpr std::size_t kLongestFunction = 6;

int column_of(std::size_t at) noexcept { return static_cast<int>(at) + 1; }

/// Reads one value by recursive descent over a line.
class ValueReader {
 public:
  ValueReader(std::string_view line, std::size_t& at, const Parameters& parameters)
      : line_(line), at_(at), parameters_(parameters) {}

  Expected<double> value();
  /// Operands joined by operators of a strength or more.
  Expected<double> operation(int least_strength);
  Expected<void> expect(char wanted, std::string_view where);

 private:
  char peek() noexcept {
    skip_blanks(line_, at_);
    return at_or_zero(line_, at_);
  }
  Expected<double> unsigned_value();
  Expected<double> parameter();
  Expected<double> bracketed();
  Expected<double> function();
  Expected<double> exists();
  Expected<double> of_two(std::string_view name, int column);
  Expected<double> apply_to_null(Operator op, double left, double right, int column);
  Expected<double> plain_number();
  tl::unexpected<Error> no_value() const;

  std::string_view line_;
  std::size_t& at_;
  const Parameters& parameters_;
  int depth_ = 0;
};

Expected<double> ValueReader::value() {
  const char sign = peek();
  if (sign != '+' && sign != '-') {
    return unsigned_value();
  }
  ++at_;
  TWIN_TRY(const double magnitude, unsigned_value());
  return is_null(magnitude) || sign == '+' ? magnitude : -magnitude;
}

Expected<double> ValueReader::unsigned_value() {
  if (++depth_ > kDeepest) {
    return fail_at(
        column_of(at_),
        fmt::format("the value is nested too deep: expected at most {} levels", kDeepest));
  }
  const char c = peek();
  Expected<double> found = c == '#'               ? parameter()
                           : c == '['             ? bracketed()
                           : is_letter(c)         ? function()
                           : c == '+' || c == '-' ? value()
                                                  : plain_number();
  --depth_;
  return found;
}

Expected<double> ValueReader::plain_number() {
  const std::size_t begin = at_;
  const Number number = parse_number(line_.substr(begin));
  if (number.status == NumberStatus::kMissing) {
    return no_value();
  }
  if (number.status == NumberStatus::kTooLarge) {
    return fail_at(column_of(begin),
                   fmt::format("the number is too large: expected at most {:.0f}", kLargestNumber));
  }
  at_ += number.length;
  return number.value;
}

tl::unexpected<Error> ValueReader::no_value() const {
  if (at_ >= line_.size()) {
    return fail_at(column_of(at_), "the line ends where a number, #, [ or a function is expected");
  }
  const char c = line_[at_];
  return fail_at(column_of(at_),
                 is_printable(c) ? fmt::format("expected a number, #, [ or a function, found '{}'",
                                               start_of(line_.substr(at_)))
                                 : not_text(c));
}

Expected<double> ValueReader::parameter() {
  const int column = column_of(at_);
  ++at_;
  if (peek() != '<') {
    TWIN_TRY(const double number, unsigned_value());
    return parameters_.numbered(or_zero(number), column);
  }
  const std::size_t end = line_.find('>', at_);
  if (end == std::string_view::npos) {
    return fail_at(column_of(at_), "the name of a parameter has no end: expected >");
  }
  const std::string_view name = line_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return parameters_.named(name, column);
}

Expected<double> ValueReader::bracketed() {
  const std::size_t opened = at_;
  ++at_;
  TWIN_TRY(const double found, operation(1));
  if (peek() != ']') {
    if (at_ >= line_.size()) {
      return fail_at(column_of(opened), "the expression has no end: expected ]");
    }
    return fail_at(column_of(at_), fmt::format("expected an operator or ], found '{}'",
                                               start_of(line_.substr(at_))));
  }
  ++at_;
  return found;
}

/// By precedence climbing.
Expected<double> ValueReader::operation(int least_strength) {
  TWIN_TRY(double left, value());
  while (true) {
    peek();
    std::size_t behind = at_;
    const Operator op = read_operator(line_, behind);
    if (op == Operator::kNone || strength(op) < least_strength) {
      return left;
    }
    const int column = column_of(at_);
    at_ = behind;
    TWIN_TRY(const double right, operation(strength(op) + 1));
    if (is_null(left) || is_null(right)) {
      TWIN_TRY(left, apply_to_null(op, left, right, column));
    } else {
      TWIN_TRY(left, apply(op, left, right, parameters_.dialect(), column));
    }
  }
}

/// Null equals nothing but null, and is 0 to every other operator.
Expected<double> ValueReader::apply_to_null(Operator op, double left, double right, int column) {
  if (op == Operator::kEqual || op == Operator::kNotEqual) {
    const bool are_equal = is_null(left) == is_null(right);
    return are_equal == (op == Operator::kEqual) ? 1.0 : 0.0;
  }
  return apply(op, or_zero(left), or_zero(right), parameters_.dialect(), column);
}

Expected<double> ValueReader::function() {
  const std::size_t begin = at_;
  std::array<char, kLongestFunction> name{};
  std::size_t length = 0;
  while (is_letter(peek())) {
    if (length == name.size()) {
      at_ = begin;
      return no_value();
    }
    name[length++] = upper(line_[at_++]);
  }
  const std::string_view word(name.data(), length);
  if (peek() != '[') {
    at_ = begin;
    return no_value();
  }
  if (word == "EXISTS") {
    return exists();
  }
  if (word == "ATAN" || (word == "POW" && parameters_.dialect() == Dialect::kFanuc)) {
    return of_two(word, column_of(begin));
  }
  TWIN_TRY(const double argument, bracketed());
  return apply_function(word, or_zero(argument), parameters_.dialect(), column_of(begin));
}

/// ATAN[y]/[x], or ATAN[y, x] and POW[x, y].
Expected<double> ValueReader::of_two(std::string_view name, int column) {
  ++at_;
  TWIN_TRY(const double first, operation(1));
  const bool has_comma = peek() == ',';
  if (has_comma) {
    ++at_;
  } else {
    TWIN_CHECK(expect(']', name));
    TWIN_CHECK(expect('/', name));
    TWIN_CHECK(expect('[', name));
  }
  TWIN_TRY(const double second, operation(1));
  TWIN_CHECK(expect(']', name));
  if (name == "POW") {
    return apply(Operator::kPower, or_zero(first), or_zero(second), parameters_.dialect(), column);
  }
  return arc_tangent(or_zero(first), or_zero(second), parameters_.dialect());
}

Expected<double> ValueReader::exists() {
  ++at_;
  TWIN_CHECK(expect('#', "EXISTS"));
  if (const char c = peek(); is_digit(c) || c == '#' || c == '[') {
    TWIN_TRY(const double number, unsigned_value());
    TWIN_CHECK(expect(']', "EXISTS"));
    return Parameters::exists(number) ? 1.0 : 0.0;
  }
  TWIN_CHECK(expect('<', "EXISTS"));
  const std::size_t end = line_.find('>', at_);
  if (end == std::string_view::npos) {
    return fail_at(column_of(at_), "the name of a parameter has no end: expected >");
  }
  const std::string_view name = line_.substr(at_, end - at_);
  at_ = end + 1;
  TWIN_CHECK(expect(']', "EXISTS"));
  return parameters_.exists(name) ? 1.0 : 0.0;
}

Expected<void> ValueReader::expect(char wanted, std::string_view where) {
  if (peek() == wanted) {
    ++at_;
    return {};
  }
  if (at_ >= line_.size()) {
    return fail_at(column_of(at_),
                   fmt::format("{}: the line ends where {} is expected", where, wanted));
  }
  return fail_at(column_of(at_), fmt::format("{}: expected {}, found '{}'", where, wanted,
                                             start_of(line_.substr(at_))));
}

}  // namespace

Expected<double> read_value(std::string_view line, std::size_t& at, const Parameters& parameters) {
  TWIN_TRY(const double value, ValueReader(line, at, parameters).value());
  return or_zero(value);
}

Expected<double> read_value_or_null(std::string_view line, std::size_t& at,
                                    const Parameters& parameters) {
  return ValueReader(line, at, parameters).value();
}

Expected<void> read_assignment(std::string_view line, std::size_t& at, Parameters& parameters) {
  const int column = column_of(at);
  ValueReader reader(line, at, parameters);
  ++at;
  skip_blanks(line, at);
  if (at_or_zero(line, at) != '<') {
    TWIN_TRY(const double given, reader.value());
    const double number = or_zero(given);
    TWIN_CHECK(reader.expect('=', "a parameter"));
    TWIN_TRY(const double value, reader.operation(1));
    return parameters.set_later(number, value, column);
  }
  const std::size_t end = line.find('>', at);
  if (end == std::string_view::npos) {
    return fail_at(column_of(at), "the name of a parameter has no end: expected >");
  }
  const std::string_view name = line.substr(at + 1, end - at - 1);
  at = end + 1;
  TWIN_CHECK(reader.expect('=', "a parameter"));
  TWIN_TRY(const double value, reader.operation(1));
  return parameters.set_later(name, value, column);
}

}  // namespace twin::gcode
