#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> count{0};
thread_local std::int64_t count_of_thread = 0;

void* counted(std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  ++count_of_thread;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace twin::test {

std::int64_t allocations() noexcept { return count.load(std::memory_order_relaxed); }
std::int64_t allocations_of_thread() noexcept { return count_of_thread; }

}  // namespace twin::test
