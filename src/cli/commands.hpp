#pragma once

#include <atomic>

#include "cli/identify_options.hpp"
#include "cli/options.hpp"
#include "core/error.hpp"

/// The subcommands, one file each. They return what keeps the exit status from being 0.
namespace twin::cli {

Expected<void> run_command(const Options& options, const std::atomic<bool>& stop);
Expected<void> plan_command(const Options& options, const std::atomic<bool>& stop);
Expected<void> circle_command(const Options& options, const std::atomic<bool>& stop);
Expected<void> check_command(const Options& options);
Expected<void> convert_command(const Options& options);
Expected<void> render_command(const Options& options);
Expected<void> compare_command(const Options& options, const std::atomic<bool>& stop);
Expected<void> reproduce_command(const Options& options, const std::atomic<bool>& stop);
Expected<void> identify_command(const Options& options, const IdentifyOptions& identify_options,
                                const std::atomic<bool>& stop);

}  // namespace twin::cli
