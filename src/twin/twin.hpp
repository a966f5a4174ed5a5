#pragma once

/// Everything that the library has for other programs.
#include "twin/batch.hpp"
#include "twin/error.hpp"
#include "twin/identify.hpp"
#include "twin/interpolator.hpp"
#include "twin/machine.hpp"
#include "twin/machines.hpp"
#include "twin/plan.hpp"
#include "twin/program.hpp"
#include "twin/run.hpp"
#include "twin/servo.hpp"
#include "twin/set_point.hpp"
#include "twin/settings.hpp"
#include "twin/studies.hpp"
#include "twin/summary.hpp"
#include "twin/trace.hpp"
#include "twin/video.hpp"
