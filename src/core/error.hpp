#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "twin/error.hpp"

namespace twin {

template <class T>
using Expected = tl::expected<T, Error>;

/// Shorthand for returning an error that is not about a place in a file.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message), {}, 0, 0});
}

/// What a call of a public header returns, nothing or why not, as an Expected.
///
///   TWIN_CHECK(checked(machine.activate()));
inline Expected<void> checked(std::optional<Error> why_not) {
  return why_not ? Expected<void>(tl::unexpected<Error>(*std::move(why_not))) : Expected<void>();
}

/// An Expected as a public header returns it: nothing, or why not.
inline std::optional<Error> why_not(Expected<void> result) {
  return result ? std::nullopt : std::optional<Error>(std::move(result).error());
}

}  // namespace twin

#define TWIN_JOINED_2(a, b) a##b
#define TWIN_JOINED(a, b) TWIN_JOINED_2(a, b)
#define TWIN_TRY_AS(name, declaration, ...)         \
  auto name = (__VA_ARGS__);                        \
  if (!name) {                                      \
    return tl::unexpected(std::move(name).error()); \
  }                                                 \
  declaration = *std::move(name)

/// Takes the value of an Expected, or returns its error from the function around.
///
///   TWIN_TRY(const double x, read_number(text));
#define TWIN_TRY(declaration, ...) \
  TWIN_TRY_AS(TWIN_JOINED(twin_try_, __LINE__), declaration, __VA_ARGS__)

/// Goes on if an Expected has no error, or returns its error from the function around.
///
///   TWIN_CHECK(write_whole_file(file, text));
#define TWIN_CHECK(...)                                     \
  if (auto twin_checked = (__VA_ARGS__); !twin_checked) {   \
    return tl::unexpected(std::move(twin_checked).error()); \
  } else /* so that it stands where a statement stands */   \
    static_cast<void>(0)
