#include "scene_options.h"

#include <fmt/format.h>

#include <CLI/Validators.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>

#include "outcome.h"
#include "progress_line.h"

namespace laterna::app {

namespace {

// What a rig says of its environment stays, but for the picture.
void add_environment(Scene& scene, const std::string& file) {
  Environment environment = scene.environment.value_or(Environment());
  environment.picture = static_cast<int>(scene.pictures.size());
  environment.chart.reset();
  environment.specular_pictures.clear();
  environment.irradiance.reset();
  scene.environment = environment;
  Picture picture;
  picture.file = file;
  picture.name = file;
  scene.pictures.push_back(std::move(picture));
}

// By the XDG base directory specification; empty where there is no home.
std::filesystem::path environment_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const bool has_cache = cache != nullptr && *cache == '/';
  if (!has_cache && (home == nullptr || *home == '\0')) return {};
  const std::filesystem::path base =
      has_cache ? std::filesystem::path(cache) : std::filesystem::path(home) / ".cache";
  return base / "laterna" / "environments";
}

}  // namespace

Error bad_option(std::string message) { return {Failure::bad_usage, Diagnostic{{}, {}, std::move(message)}}; }

void SceneOptions::declare_scene(CLI::App& command) {
  command.add_option("SCENE", files, "glTF, GLB, OBJ, PLY, STL, MD2, …; several are merged")->required();
  command
      .add_option("--rig", rigs,
                  "JSON with cameras, lights and projectors by name; may be given several times")
      ->allow_extra_args(false);
  command.add_option("--environment", environment,
                     "picture of all directions that lights the scene and stands behind it, such as sky.hdr");
  command.add_option("--up", up, "which axis points up in formats that do not say")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  command.add_option("--unit", unit, "what one unit is in formats that do not say")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}))
      ->capture_default_str();
  command.add_option(
      "--clip", clip,
      "animation that plays: a name that laterna info tells, all or none; by default the first of "
      "each file");
  command.add_option("--time", time, "scene time in seconds, at which films and clips are shown")
      ->capture_default_str();
}

namespace {

// CLI11's own range says of "2GB" that it is out of range, which does not tell that no unit may follow.
CLI::Validator whole_megabytes(std::uint64_t most) {
  return {
      [most](std::string& text) {
        std::uint64_t number = 0;
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (fault == std::errc() && end == text.data() + text.size() && number <= most) return std::string();
        return fmt::format(
            "expected a whole number of megabytes from 0 to {}, without a unit (2048 for 2 GB), got \"{}\"",
            most, text);
      },
      fmt::format("MEGABYTES in [0 - {}]", most)};
}

}  // namespace

void SceneOptions::declare_machine(CLI::App& command) {
  command.add_option("--threads", threads, "0: one per processor; the picture is the same for any number")
      ->capture_default_str();
  command.add_flag("--no-cache", no_cache,
                   "do not keep what was worked out from environments, nor use what was kept");
  command
      .add_option("--cache-memory", cache_megabytes,
                  "megabytes of shadow maps that are kept from picture to picture; 0: none")
      ->check(whole_megabytes(kMaxCacheBytes >> 20U))
      ->capture_default_str();
  command.add_option("--isa", instruction_set,
                     "instruction set: scalar, sse4, avx2, avx512 or neon; the picture is the same");
}

namespace {

// One note is enough, whatever clips there are.
void tell_contending_clips(const Scene& scene) {
  using Moved = std::tuple<AnimatedProperty, int, bool, int>;
  std::map<Moved, const Clip*> mover_of;
  for (const Clip& clip : scene.clips) {
    if (!clip.plays || clip.is_path) continue;
    for (const ClipChannel& c : clip.channels) {
      const auto [known, is_new] = mover_of.try_emplace({c.property, c.target, c.of_light, c.texture}, &clip);
      if (is_new || known->second == &clip) continue;
      fmt::print(stderr,
                 "laterna: note: --clip: several clips move the same things, \"{}\" and \"{}\" among them: "
                 "of such clips "
                 "the last one is seen\n",
                 known->second->name, clip.name);
      return;
    }
  }
}

}  // namespace

double SceneOptions::metres_per_unit() const {
  static const std::map<std::string, double> kMetres = {
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};
  return kMetres.at(unit);
}

Result<Scene> SceneOptions::load() const {
  LoadOptions options;
  options.up = up == "z" ? LoadOptions::Up::z : LoadOptions::Up::y;
  options.metres_per_unit = metres_per_unit();
  options.rigs.assign(rigs.begin(), rigs.end());
  Result<Scene> scene = load_scene({files.begin(), files.end()}, options);
  if (!scene) return scene;
  if (!environment.empty()) add_environment(*scene, environment);
  report_warnings(scene->warnings);
  if (clip.empty()) return scene;
  const Result<void> chosen = choose_clip(*scene, clip);
  if (!chosen) return tl::unexpected(bad_option("--clip: " + to_string(chosen.error())));
  tell_contending_clips(*scene);
  return scene;
}

Result<RendererOptions> SceneOptions::renderer_options() const {
  RendererOptions options;
  options.threads = threads;
  if (!no_cache) options.environment_cache = environment_cache();
  options.environment_progress = progress_line("filtering the environment");
  options.time = time;
  options.cache_bytes = cache_megabytes << 20U;
  if (instruction_set.empty()) return options;
  options.instruction_set = instruction_set_named(instruction_set);
  if (!options.instruction_set) {
    return tl::unexpected(bad_option(fmt::format(
        "--isa: there is no instruction set \"{}\"; there are scalar, sse4, avx2, avx512 and neon",
        instruction_set)));
  }
  return options;
}

Result<Renderer> SceneOptions::make_renderer(const std::function<void(Scene&)>& amend) const {
  const Result<RendererOptions> options = renderer_options();
  if (!options) return tl::unexpected(options.error());
  Result<Scene> scene = load();
  if (!scene) return tl::unexpected(std::move(scene.error()));
  if (amend) amend(*scene);
  const std::size_t told = scene->warnings.size();
  Result<Renderer> renderer = Renderer::create(std::move(*scene), *options);
  if (renderer) {
    const std::vector<Diagnostic>& all = renderer->scene().warnings;
    report_warnings({all.begin() + static_cast<std::ptrdiff_t>(told), all.end()});
  }
  return renderer;
}

void declare_written_environment(CLI::App& command, ImageBasedLightSettings& settings) {
  command
      .add_option("--environment-size", settings.face_size,
                  "pixels of an environment's six faces where nothing is rough: 32, 64, ... 4096")
      ->capture_default_str();
}

void ViewOptions::declare(CLI::App& command) {
  command.add_option("--camera", camera, "camera by name; without it the scene's first, or an overview");
  command.add_option("--from-light", from_light, "look with a light's eyes instead");
  command.add_option("--size", size, "width x height in pixels")->capture_default_str();
}

Result<ViewOptions::Size> ViewOptions::parse_size() const {
  Size parsed{};
  const std::size_t x = size.find('x');
  const auto number = [&](std::string_view text, int& value) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size() && value > 0;
  };
  const std::string_view text = size;
  if (x == std::string::npos || !number(text.substr(0, x), parsed.width) ||
      !number(text.substr(x + 1), parsed.height)) {
    return tl::unexpected(
        bad_option(fmt::format("--size: expected WIDTHxHEIGHT such as 1920x1080, got \"{}\"", size)));
  }
  return parsed;
}

namespace {

// A light's view fills the picture, whatever their shapes.
void advise_shape(const View& light, const ViewOptions::Size& picture) {
  const Projection& p = light.projection;
  const double shape = (p.right - p.left) / (p.top - p.bottom);
  constexpr double kSeen = 0.01;
  if (std::abs(shape * picture.height / picture.width - 1) < kSeen) return;
  fmt::print(stderr,
             "laterna: note: the light's view is stretched to the picture: --size {}x{} keeps its shape\n",
             std::lround(shape * picture.height), picture.height);
}

}  // namespace

Result<View> ViewOptions::find(const Renderer& renderer, const Size& picture) const {
  if (!from_light.empty()) {
    if (!camera.empty()) return tl::unexpected(bad_option("--camera and --from-light exclude each other"));
    Result<View> view = renderer.light_view(from_light);
    if (view) advise_shape(*view, picture);
    return view;
  }
  Result<View> view = renderer.camera_view(camera, picture.width, picture.height);
  if (view || !camera.empty()) return view;
  fmt::print(stderr, "laterna: note: the scene has no camera: showing all of it\n");
  return renderer.overview(picture.width, picture.height);
}

Result<View> ViewOptions::follow(const Renderer& renderer, const Size& picture, const View& first) const {
  if (!from_light.empty()) return renderer.light_view(from_light);
  Result<View> view = renderer.camera_view(camera, picture.width, picture.height);
  return view || !camera.empty() ? view : first;
}

}  // namespace laterna::app
