// laterna gallery: the figures of the papers re-made, as one page that works from a file without a network.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "gallery/page.h"
#include "gallery/sitting.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  SceneOptions machine;
  std::string folder;
  std::vector<std::string> only;
  double scale = 1;
  bool list = false;
};

std::vector<Chapter> all_chapters() {
  return {segal_1992_chapter(), chen_tung_chapter(),   mit_lecture_20_chapter(), wikipedia_chapter(),
          bentley_chapter(),    environment_chapter(), later_chapter(),          lens_chapter(),
          photograph_chapter(), lamp_chapter(),        material_chapter(),       relief_chapter(),
          mirror_chapter()};
}

int list_figures() {
  for (const Chapter& chapter : all_chapters()) {
    fmt::print("{}\n", chapter.document);
    for (const Figure& figure : chapter.figures) fmt::print("  {:<24} {}\n", figure.id, figure.title);
  }
  return kOk;
}

Error cannot_write(const std::filesystem::path& file, std::string message) {
  return {Failure::cannot_write, Diagnostic{file.string(), {}, std::move(message)}};
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return tl::unexpected(cannot_write(folder, "cannot make this folder: " + failure.message()));
  return check_image_output(folder / "gallery.png");
}

/// The page is there whole or not at all.
Result<void> write_page(const std::string& html, const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << html;
  stream.close();
  std::error_code failure;
  if (stream) std::filesystem::rename(part, file, failure);
  if (stream && !failure) return {};
  std::filesystem::remove(part, failure);
  return tl::unexpected(cannot_write(file, "cannot write this file"));
}

/// The chapters with the figures that were asked for, still without pictures.
Result<std::vector<DrawnChapter>> choose(const std::vector<Chapter>& chapters,
                                         const std::vector<std::string>& only) {
  std::vector<std::string> known;
  std::vector<DrawnChapter> chosen;
  for (const Chapter& chapter : chapters) {
    DrawnChapter drawn{&chapter, {}};
    for (const Figure& figure : chapter.figures) {
      known.emplace_back(figure.id);
      if (only.empty() || std::ranges::find(only, figure.id) != only.end())
        drawn.figures.push_back({&figure, {}});
    }
    if (!drawn.figures.empty()) chosen.push_back(std::move(drawn));
  }
  for (const std::string& id : only) {
    if (std::ranges::find(known, id) == known.end()) {
      return tl::unexpected(bad_option(
          fmt::format("--only: there is no figure \"{}\"; there are {}", id, fmt::join(known, ", "))));
    }
  }
  return chosen;
}

Result<void> draw_all(std::vector<DrawnChapter>& chapters, const Darkroom& darkroom) {
  std::size_t count = 0;
  for (const DrawnChapter& chapter : chapters) count += chapter.figures.size();
  const Progress progress = progress_line("drawing figures");
  std::size_t done = 0;
  for (DrawnChapter& chapter : chapters) {
    for (DrawnFigure& drawn : chapter.figures) {
      if (progress) progress(static_cast<double>(done++) / static_cast<double>(count));
      Sitting sitting(darkroom, drawn.figure->id);
      drawn.figure->draw(sitting);
      if (!sitting.outcome()) return sitting.outcome();
      drawn.panels = sitting.panels();
    }
  }
  return {};
}

int run_gallery(const Options& options) {
  if (options.list) return list_figures();
  const auto start = std::chrono::steady_clock::now();
  if (options.folder.empty())
    return report(bad_option("-o DIR: expected the folder that the page is written to"));
  const Result<RendererOptions> machine = options.machine.renderer_options();
  if (!machine) return report(machine.error());
  const std::vector<Chapter> chapters = all_chapters();
  Result<std::vector<DrawnChapter>> chosen = choose(chapters, options.only);
  if (!chosen) return report(chosen.error());
  const std::filesystem::path folder = options.folder;
  if (const Result<void> made = make_folder(folder); !made) return report(made.error());
  if (const Result<void> drawn = draw_all(*chosen, {folder, options.scale, *machine}); !drawn)
    return report(drawn.error());
  const std::filesystem::path page = folder / "index.html";
  if (const Result<void> written = write_page(gallery_page(*chosen), page); !written)
    return report(written.error());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  fmt::print(stderr, "laterna: drawn in {:.0f} s: open {}\n", taken.count(), page.string());
  return kOk;
}

}  // namespace

void declare_gallery(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("gallery", "the figures of the papers re-made, as one page");
  command->add_option("-o,--output", options->folder,
                      "folder for index.html and its pictures; made if need be");
  command->add_option("--only", options->only, "a figure by its id; may be given again")
      ->allow_extra_args(false);
  command->add_flag("--list", options->list, "print the figures and end");
  command->add_option("--scale", options->scale, "of the pictures' sides")
      ->check(CLI::Range(0.05, 4.0))
      ->capture_default_str();
  options->machine.declare_machine(*command);
  command->footer("\nExample:\n  laterna gallery -o gallery\n");
  command->callback([options, &run] { run = [options] { return run_gallery(*options); }; });
}

}  // namespace laterna::app
