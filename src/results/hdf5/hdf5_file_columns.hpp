#pragma once

#include "results/trace/hdf5.hpp"

namespace twin::results::hdf5 {

/// Hdf5Module::open.
Expected<std::unique_ptr<Hdf5Columns>> open_columns(const std::filesystem::path& file);

}  // namespace twin::results::hdf5
