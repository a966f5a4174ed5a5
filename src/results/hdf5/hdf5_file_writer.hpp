#pragma once

#include "results/trace/hdf5.hpp"

namespace twin::results::hdf5 {

/// Hdf5Module::create.
Expected<std::unique_ptr<Hdf5Writer>> create_writer(const std::filesystem::path& file,
                                                    const std::vector<TraceColumn>& columns);

/// Hdf5Module::write_table.
Expected<void> write_table(const std::filesystem::path& file,
                           const std::vector<Hdf5TableColumn>& columns);

}  // namespace twin::results::hdf5
