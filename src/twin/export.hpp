#pragma once

/// Marks what the shared library shows to programs that use it; all else in it is hidden.
#define TWIN_EXPORT __attribute__((visibility("default")))
