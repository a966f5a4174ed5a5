#pragma once

#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"

/// The part of `twin compare` that is about runs of one kind: folders of earlier runs, or runs of a
/// program with several values of some settings.
namespace twin::cli {

/// A run among several that differ in settings.
struct SettingsVariant {
  std::string name;                   ///< "servo.x.kp=200"; of several settings joined by commas
  std::vector<std::string> settings;  ///< all of its --set
};

/// The variants that some --set ask for. A setting that is given once holds for all; one that is
/// given n times has a value in each of n variants, in order.
///
/// @returns nothing if no setting is given twice; a kUsage error if two settings are given several
///          times, but not equally often
Expected<std::vector<SettingsVariant>> variants_of(const std::vector<std::string>& settings);

/// Whether what is compared are folders of earlier runs.
bool are_folders(const std::vector<std::string>& names);

/// Writes the page of some folders of runs.
Expected<void> compare_folders(const CompareArguments& arguments, const Environment& environment);

/// Runs a program in each variant, prints a table, writes the page of all.
Expected<void> compare_variants(const CompareArguments& arguments,
                                const std::vector<SettingsVariant>& variants,
                                const gcode::ProgramText& program, const Environment& environment);

}  // namespace twin::cli
