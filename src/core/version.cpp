#include "core/version.hpp"

namespace twin {

std::string_view version() noexcept { return TWIN_VERSION; }

}  // namespace twin
