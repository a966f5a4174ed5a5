#pragma once

#include <string_view>

namespace twin {

/// Version of this project, as in "0.9.0".
std::string_view version() noexcept;

}  // namespace twin
