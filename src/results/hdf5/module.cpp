#include <type_traits>

#include "results/hdf5/hdf5_file_columns.hpp"
#include "results/hdf5/hdf5_file_writer.hpp"

extern "C" __attribute__((visibility("default"))) const twin::results::Hdf5Module* twin_hdf5() {
  static_assert(std::is_same_v<decltype(&twin_hdf5), twin::results::GiveHdf5Module>);
  static constexpr twin::results::Hdf5Module kModule{&twin::results::hdf5::create_writer,
                                                     &twin::results::hdf5::open_columns,
                                                     &twin::results::hdf5::write_table};
  return &kModule;
}
