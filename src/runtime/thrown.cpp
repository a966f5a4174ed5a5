#include "runtime/thrown.hpp"

#include <fmt/format.h>

#include <exception>
#include <string>

namespace twin::runtime {

Error thrown(const char* where) {
  std::string what = "unknown exception";
  try {
    throw;
  } catch (const std::exception& exception) {
    what = exception.what();
  } catch (...) {
  }
  return {ErrorCode::kMachine, fmt::format("{} failed: {}", where, what), {}, 0, 0};
}

}  // namespace twin::runtime
