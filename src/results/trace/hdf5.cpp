#include "results/trace/hdf5.hpp"

#include <array>
#include <fstream>
#include <system_error>

#include "core/module.hpp"

namespace twin::results {

Expected<const Hdf5Module*> hdf5_module() {
  TWIN_TRY(void* const function,
           load_module({"twin-hdf5.so", kGiveHdf5ModuleName, "the reader and writer of HDF5"}));
  return reinterpret_cast<GiveHdf5Module>(function)();
}

bool is_hdf5(const std::filesystem::path& file) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    return false;
  }
  std::ifstream in(file, std::ios::binary);
  // A block of the user's own may come first, of 512 bytes or a power of two times as much.
  for (const std::streamoff offset : {0, 512, 1024, 2048, 4096}) {
    std::array<char, kSignature.size()> begin{};
    if (!in.seekg(offset) || !in.read(begin.data(), begin.size())) {
      return false;
    }
    if (std::string_view(begin.data(), begin.size()) == kSignature) {
      return true;
    }
  }
  return false;
}

}  // namespace twin::results
