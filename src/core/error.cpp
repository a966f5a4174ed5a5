#include "core/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace twin {

std::string to_string(const Error& error) {
  std::string place = error.file;
  if (error.line > 0) {
    place += fmt::format("{}{}", place.empty() ? "line " : ":", error.line);
    if (error.column > 0) {
      place += fmt::format(":{}", error.column);
    }
  }
  return place.empty() ? error.message : place + ": " + error.message;
}

int exit_status(const Error& error) noexcept {
  switch (error.code) {
    case ErrorCode::kUsage:
      return 2;
    case ErrorCode::kInterrupted:
      return 130;
    default:
      return 1;
  }
}

Failure::Failure(Error error)
    : std::runtime_error(to_string(error)), error_(std::make_shared<Error>(std::move(error))) {}

}  // namespace twin
