#include <algorithm>
#include <limits>
#include <utility>

#include "gcode/reading.hpp"

// Errors, and how a reading goes on behind one.

namespace twin::gcode {
namespace {

constexpr std::int64_t kLargestLine = std::numeric_limits<int>::max();  // an Error can hold

/// Names that have no value get one, so that each is told once.
void define_names(std::string_view text, Parameters& parameters) {
  for (std::size_t at = text.find("#<"); at != std::string_view::npos;
       at = text.find("#<", at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) {
      return;
    }
    const std::string_view name = text.substr(at + 2, end - at - 2);
    if (!parameters.exists(name)) {
      static_cast<void>(parameters.set_later(name, 0.0, 0));
      parameters.commit();
    }
  }
}

}  // namespace

/// Remembers an error, with file and line if they belong to it, for this call and all that follow.
tl::unexpected<Error> Reader::Reading::stop_with(Error error) {
  if (error.file.empty()) {
    error.file = flow_.file();
  }
  if (error.column > 0 && error.line == 0) {
    error.line = static_cast<int>(std::min(flow_.line(), kLargestLine));
  }
  blocks_.count = next_block_ = 0;
  parameters_.drop();
  error_ = error;
  return tl::unexpected<Error>(std::move(error));
}

/// Forgets the error, so that the line behind it comes next.
bool Reader::Reading::resume() {
  if (!error_ || error_->code != ErrorCode::kProgram || flow_.is_broken() || is_at_end_ ||
      ++resumed_ > kMostResumed) {
    return false;
  }
  error_.reset();
  has_erred_ = true;
  if (!text_.empty()) {
    recover();
  }
  return true;
}

/// Takes of the line that failed what can be read, so that the error is no reason for others: where
/// it would have led, the modes and parameters that it sets.
void Reader::Reading::recover() {
  define_names(text_, parameters_);
  const bool is_whole = words_.read_leniently(text_, parameters_);
  parameters_.commit();
  interpreter_.recover(words_, is_whole);
}

}  // namespace twin::gcode
