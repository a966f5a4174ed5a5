#include "runtime/path_threads.hpp"

#include <utility>

#include "runtime/run_errors.hpp"

namespace twin::runtime {

void PathThreads::start() {
  building_ = std::thread([this] { build_all(); });
  try {
    reading_ = std::thread([this] { read_all(); });
  } catch (...) {
    read_error_ = thrown("reading");
    blocks_.close();
    throw;
  }
}

Expected<void> PathThreads::join() {
  join_threads();
  if (build_error_) {
    return tl::unexpected(*build_error_);
  }
  if (read_error_) {
    return tl::unexpected(*read_error_);
  }
  return {};
}

void PathThreads::join_threads() {
  segments_.stop();
  for (std::thread* thread : {&building_, &reading_}) {
    if (thread->joinable()) {
      thread->join();
    }
  }
}

void PathThreads::read_all() {
  try {
    if (auto read = read_on(); !read) {
      read_error_ = std::move(read).error();
    }
  } catch (...) {
    read_error_ = thrown("reading");
  }
  blocks_.close();
}

Expected<void> PathThreads::read_on() {
  for (;;) {
    TWIN_TRY(std::optional<gcode::Block> block, read_());
    if (!block || !blocks_.push(*std::move(block))) {
      return {};
    }
  }
}

void PathThreads::build_all() {
  try {
    build_on();
  } catch (...) {
    build_error_ = thrown("path building");
  }
  blocks_.stop();
  segments_.close();
}

void PathThreads::build_on() {
  while (const gcode::Block* block = blocks_.next()) {
    builder_.push(*block);
    if (!is_wanted_) {
      return;
    }
  }
  if (!read_error_) {
    builder_.finish();
  }
}

}  // namespace twin::runtime
