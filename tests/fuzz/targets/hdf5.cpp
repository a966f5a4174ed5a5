#include <algorithm>
#include <vector>

#include "results/hdf5/hdf5_file_columns.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace hdf5_target {

constexpr std::size_t kMostRows = 1000;  // that are read of a column

void run(Bytes bytes) {
  const MemoryFile file(bytes);
  const auto columns = results::hdf5::open_columns(file.path());
  if (!columns) {
    promise(!columns.error().message.empty(), "an error without a message");
    return;
  }
  for (std::size_t i = 0; i < (*columns)->names().size(); ++i) {
    std::vector<double> values(std::min((*columns)->rows(i), kMostRows));
    const auto read = (*columns)->read(i, 0, values);
    promise(read || !read.error().message.empty(), "an error of rows without a message");
  }
}

}  // namespace hdf5_target

const Target kHdf5{"hdf5", hdf5_target::run};

}  // namespace twin::fuzz
