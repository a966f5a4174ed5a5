#include "results/hdf5/hdf5_calls.hpp"

#include <fmt/format.h>

namespace twin::results::hdf5 {
namespace {

std::recursive_mutex& calls_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

/// The library would close at exit what it could not close before, as a file on a full disk, and ends the
/// process by a fault of memory there. Every file is closed by its owner. First call of the library.
bool leaves_exit_alone() {
  static const bool leaves = H5dont_atexit() >= 0;
  return leaves;
}

}  // namespace

Calls::Calls() : lock_(calls_mutex()) {
  static_cast<void>(leaves_exit_alone());
  H5Eget_auto2(H5E_DEFAULT, &report_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Calls::~Calls() { H5Eset_auto2(H5E_DEFAULT, report_, data_); }

tl::unexpected<Error> library_error(const std::string& file, const char* action) {
  std::string words;
  const auto take_innermost = [](unsigned, const H5E_error2_t* error, void* into) -> herr_t {
    *static_cast<std::string*>(into) = error->desc;
    return 1;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &words);
  return tl::unexpected(
      Error{ErrorCode::kFile,
            fmt::format("cannot {}{}{}", action, words.empty() ? "" : ": ", words), file, 0, 0});
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  H5Pset_file_locking(access.id(), false, true);
  return access;
}

}  // namespace twin::results::hdf5
