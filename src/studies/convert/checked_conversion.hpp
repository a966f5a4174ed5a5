#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/reader.hpp"
#include "studies/convert/converter.hpp"
#include "studies/convert/program_deviation.hpp"

namespace twin::studies::convert {

/// A program that is to be converted, and how its runs of short blocks are fitted.
struct Job {
  gcode::ProgramText program;
  gcode::ReaderOptions reading;
  PathSettings path;
  PlanningModel planning;
  Limits limits;
};

/// A converted program that was held against the original.
struct CheckedConversion {
  Conversion conversion;
  Deviation deviation;  ///< from the programmed path
};

/// Converts a program, reads the new one back, and holds it against the old one. Where the dialect
/// is none that the reader reads, the same curves with the same digits are read back as G6.2.
///
/// @param dialect  one of dialect_names()
/// @returns the new program; or the error of the old one, or that the new one would leave the
/// tolerance
Expected<CheckedConversion> convert_and_check(const Job& job, const std::string& dialect);

/// What became of the program, as a table for the terminal.
std::string to_table(const Job& job, const std::string& dialect, const CheckedConversion& checked);

}  // namespace twin::studies::convert
