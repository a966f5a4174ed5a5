#pragma once

#include "core/error.hpp"

namespace twin::runtime {

/// What was thrown, as an error of the run; called in a catch block. @param where who threw it
Error thrown(const char* where);

}  // namespace twin::runtime
