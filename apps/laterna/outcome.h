// What a command ends with.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "laterna/result.h"

namespace laterna::app {

/// Exit codes of the command line.
enum ExitCode : int { kOk = 0, kComparisonFailed = 1, kBadUsage = 2, kBadInput = 3, kCannotWrite = 4 };

/// Prints every diagnostic to stderr and gives the exit code of the failure.
int report(const Error& error);
/// Prints what was left out or guessed.
void report_warnings(const std::vector<Diagnostic>& warnings);

/// A command's work, run once its options have been read.
using Run = std::function<int()>;

/// Declares a subcommand; `run` is set when it is chosen.
using DeclareCommand = void (*)(CLI::App& app, Run& run);
void declare_render(CLI::App& app, Run& run);
void declare_info(CLI::App& app, Run& run);
void declare_inspect(CLI::App& app, Run& run);
void declare_false_color(CLI::App& app, Run& run);
void declare_probe(CLI::App& app, Run& run);
void declare_depthmap(CLI::App& app, Run& run);
void declare_ies(CLI::App& app, Run& run);
void declare_diff(CLI::App& app, Run& run);
void declare_bench(CLI::App& app, Run& run);
void declare_accuracy(CLI::App& app, Run& run);
void declare_gallery(CLI::App& app, Run& run);
void declare_photo(CLI::App& app, Run& run);
void declare_convert(CLI::App& app, Run& run);
void declare_bake(CLI::App& app, Run& run);
void declare_environment(CLI::App& app, Run& run);
void declare_doctor(CLI::App& app, Run& run);

}  // namespace laterna::app
