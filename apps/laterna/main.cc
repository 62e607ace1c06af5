// The command line: reads which command is wanted, runs it, and turns how it ended into an exit code.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "laterna/build_info.h"
#include "laterna/output.h"
#include "outcome.h"

namespace {

// Ctrl-C leaves no half-written file.
extern "C" void stop(int signal) {
  laterna::remove_pending_outputs();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

constexpr const char* kDescription =
    "laterna: what projected light does to a 3D scene. Slide projectors, spotlights and suns\n"
    "with shadows, rendered without a GPU or a display; the same picture on every machine.\n";

bool is_command(const CLI::App& app, const std::string& name) {
  return !app.get_subcommands([&](const CLI::App* command) { return command->check_name(name); }).empty();
}

int report_unknown_command(const CLI::App& app, const std::string& name) {
  std::string known;
  for (const CLI::App* command : app.get_subcommands({})) known += " " + command->get_name();
  fmt::print(stderr, "laterna: error: there is no command \"{}\"; there are{}\n", name, known);
  return laterna::app::kBadUsage;
}

// "laterna help bake" is "laterna bake --help".
void ask_for_help(std::vector<std::string>& words) {
  words.erase(words.begin());
  words.resize(std::min<std::size_t>(words.size(), 1));
  words.emplace_back("--help");
}

constexpr const char* kFooter =
    "\nExamples:\n"
    "  laterna render scene.glb -o picture.png\n"
    "  laterna render house.glb --rig stage.json --camera front -o picture.png --exposure auto\n"
    "  laterna render scene.glb --rig stage.json -o layers.exr --layers light,visibility,depth\n"
    "  laterna info scene.glb\n"
    "\n'laterna COMMAND --help' tells more about a command.\n"
    "Exit codes: 0 ok, 1 a comparison failed, 2 bad usage, 3 bad input, 4 could not write.";

int run_command(std::vector<std::string> words) {
  CLI::App app(kDescription, "laterna");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    const std::string help =
        failed->get_help_ptr() == nullptr ? "" : "Run with --help for more information.\n";
    return fmt::format("laterna: error: {}\n{}", error.what(), help);
  });
  app.set_version_flag("--version", "laterna " + laterna::version());
  laterna::app::Run run;
  for (const laterna::app::DeclareCommand declare :
       {laterna::app::declare_render, laterna::app::declare_info, laterna::app::declare_inspect,
        laterna::app::declare_probe, laterna::app::declare_false_color, laterna::app::declare_depthmap,
        laterna::app::declare_ies, laterna::app::declare_photo, laterna::app::declare_convert,
        laterna::app::declare_bake, laterna::app::declare_environment, laterna::app::declare_diff,
        laterna::app::declare_bench, laterna::app::declare_accuracy, laterna::app::declare_gallery,
        laterna::app::declare_doctor}) {
    declare(app, run);
  }
  if (!words.empty() && words.front() == "help") ask_for_help(words);
  if (!words.empty() && !words.front().starts_with('-') && !is_command(app, words.front()))
    return report_unknown_command(app, words.front());
  try {
    std::ranges::reverse(words);  // as parse() takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? laterna::app::kOk : laterna::app::kBadUsage;
  }
  if (!run) return laterna::app::kOk;
  const int code = run();
  // A full pipe or disk shows itself when the last of the output leaves.
  if (std::fflush(stdout) != 0) {
    fmt::print(stderr, "laterna: error: cannot write to standard output\n");
    return laterna::app::kCannotWrite;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, stop);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is a failed write, which is told
  try {
    return run_command({argv + std::min(argc, 1), argv + argc});
  } catch (const std::exception& e) {  // what reached no one who knows more: memory, most likely
    std::fprintf(stderr, "laterna: error: %s\n", e.what());
    return laterna::app::kBadInput;
  }
}
