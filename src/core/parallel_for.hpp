#pragma once

#include <cstddef>
#include <functional>

namespace twin {

/// Calls f(0) .. f(count - 1), spread over the processor's cores.
///
/// Which thread takes which index is left to chance: f writes what belongs to its index and nothing
/// else, and then the result does not depend on the number of threads. Returns when all are done.
/// The first exception ends the handing out and is thrown again here.
/// @param threads  at most so many, the caller's among them; 0: as many as there are cores
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& f,
                  unsigned threads = 0);

}  // namespace twin
