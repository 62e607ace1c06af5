// laterna photo: photographs thrown back on what they show.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "camera_path.h"
#include "laterna/measure.h"
#include "laterna/photograph_files.h"
#include "numbered_name.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

const std::map<std::string, ShadowTechnique> kVisibility = {{"exact", ShadowTechnique::exact},
                                                            {"map", ShadowTechnique::map},
                                                            {"raytraced", ShadowTechnique::raytraced}};
const std::map<std::string, PhotographBlend> kBlend = {{"surface", PhotographBlend::surface},
                                                       {"view", PhotographBlend::view}};
constexpr const char* kAll = "all";
constexpr int kMostFrames = 1'000'000;

struct PhotoOptions {
  SceneOptions scene;
  ViewOptions view;
  std::string cameras, photos, output, from, mask;
  std::string visibility = "exact", blend = "surface", unseen = "0,0,0";
  std::vector<std::string> fly, only, layers;
  double feather = PhotographSettings().feather;
  int count = 100, samples = 1;
  bool is_lit = false, keeps_exposure = false, skips_missing = false, json = false;
};

Result<glm::vec3> parse_color(const std::string& text) {
  glm::vec3 c(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f,%f,%f%c", &c.x, &c.y, &c.z, &rest) != 3) {
    return tl::unexpected(
        bad_option(fmt::format("--unseen: expected R,G,B in linear light, got \"{}\"", text)));
  }
  return c;
}

int index_of(const std::vector<Photograph>& photographs, const std::string& name) {
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    if (photographs[i].name == name) return static_cast<int>(i);
  }
  for (std::size_t i = 0; i < photographs.size(); ++i) {  // without folder, or ending
    const std::filesystem::path path(photographs[i].name);
    if (path.filename() == name || path.stem() == name) return static_cast<int>(i);
  }
  return -1;
}

Error no_photograph(const std::vector<Photograph>& photographs, const char* option, const std::string& name) {
  std::string names;
  for (const Photograph& photograph : photographs)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", photograph.name);
  return bad_option(fmt::format("{}: there is no photograph \"{}\"; there are {}", option, name, names));
}

class PhotoCommand {
 public:
  explicit PhotoCommand(const PhotoOptions& options) : o_(options) {}

  int run() {
    ViewOptions wanted = o_.view;
    if (wanted.size.empty()) wanted.size = ViewOptions().size;
    const Result<ViewOptions::Size> size = wanted.parse_size();
    if (!size) return report(size.error());
    size_ = *size;
    if (const std::string fault = find_usage_fault(); !fault.empty()) return report(bad_option(fault));
    if (!o_.fly.empty()) {
      Result<NumberedName> name = NumberedName::parse("--fly", o_.output, false);
      if (!name) return report(name.error());
      name_ = std::move(*name);
    }
    for (const std::string& file : {name_ ? name_->with(0) : o_.output, o_.mask}) {
      if (file.empty()) continue;
      if (Result<void> writable = check_image_output(file); !writable) return report(writable.error());
    }
    Result<Renderer> renderer = make_renderer();
    if (!renderer) return report(renderer.error());
    if (!o_.keeps_exposure) {
      Result<std::vector<glm::vec3>> gains = balance_photographs(*renderer, progress_line("balancing"));
      if (!gains) return report(gains.error());
      if (Result<void> set = renderer->set_photograph_gains(*gains); !set) return report(set.error());
    }
    const Result<void> drawn = o_.fly.empty() ? draw_one(*renderer) : draw_frames(*renderer);
    if (!drawn) return report(drawn.error());
    if (o_.json) print_json(renderer->scene());
    return kOk;
  }

 private:
  [[nodiscard]] std::string find_usage_fault() const {
    const bool flies = !o_.fly.empty();
    if (!flies && o_.output.find('#') != std::string::npos) return "a numbered output needs --fly";
    if (flies && (!o_.from.empty() || !o_.view.camera.empty())) return "--fly excludes --from and --camera";
    if (!o_.from.empty() && !o_.view.camera.empty()) return "--from and --camera exclude each other";
    if (flies && !o_.mask.empty()) return "--mask is of one picture: it excludes --fly";
    if (o_.json && o_.output == "-") return "--json and -o - would both write to standard output";
    if (!o_.layers.empty() && !keeps_layers(o_.output))
      return "--layers: only OpenEXR holds layers: give an output that ends in .exr";
    return {};
  }

  Result<Renderer> make_renderer() {
    const Result<RendererOptions> options = o_.scene.renderer_options();
    if (!options) return tl::unexpected(options.error());
    const Result<glm::vec3> unseen = parse_color(o_.unseen);
    if (!unseen) return tl::unexpected(unseen.error());
    Result<Scene> scene = o_.scene.load();
    if (!scene) return tl::unexpected(std::move(scene.error()));
    const std::size_t told = scene->warnings.size();
    PhotographFiles files;
    files.cameras = o_.cameras;
    files.photos = o_.photos;
    files.up = o_.scene.up == "z" ? LoadOptions::Up::z : LoadOptions::Up::y;
    files.metres_per_unit = o_.scene.metres_per_unit();
    files.skips_missing = o_.skips_missing;
    files.threads = o_.scene.threads;
    if (Result<void> added = add_photographs(*scene, files); !added)
      return tl::unexpected(std::move(added.error()));
    PhotographSettings& settings = scene->photograph_settings;
    settings.visibility = kVisibility.at(o_.visibility);
    settings.blend = kBlend.at(o_.blend);
    settings.feather = o_.feather;
    settings.are_lit = o_.is_lit;
    settings.unseen = *unseen;
    if (Result<void> kept = keep_only(*scene); !kept) return tl::unexpected(std::move(kept.error()));
    Result<Renderer> renderer = Renderer::create(std::move(*scene), *options);
    if (renderer) {
      const std::vector<Diagnostic>& all = renderer->scene().warnings;
      report_warnings({all.begin() + static_cast<std::ptrdiff_t>(told), all.end()});
    }
    return renderer;
  }

  // --only: photographs by name.
  Result<void> keep_only(Scene& scene) {
    all_ = scene.photographs;
    if (o_.only.empty()) return {};
    std::vector<Photograph> kept;
    for (const std::string& name : o_.only) {
      const int index = index_of(all_, name);
      if (index < 0) return tl::unexpected(no_photograph(all_, "--only", name));
      kept.push_back(all_[static_cast<std::size_t>(index)]);
    }
    scene.photographs = std::move(kept);
    return {};
  }

  [[nodiscard]] RenderSettings settings_for(const ViewOptions::Size& size) const {
    RenderSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.samples = o_.samples;
    for (const LayerDescription& layer : list_layers()) {
      const bool is_wanted = std::ranges::any_of(
          o_.layers, [&](const std::string& name) { return name == layer.name || name == kAll; });
      if (is_wanted && layer.layer != Layer::passes) settings.layers.push_back(layer.layer);
    }
    return settings;
  }

  Result<View> find_view(const Renderer& renderer) {
    const bool has_camera = !o_.view.camera.empty() || !renderer.scene().cameras.empty();
    if (o_.from.empty() && has_camera) return renderer.camera_view(o_.view.camera, size_.width, size_.height);
    const std::string& from = o_.from.empty() ? all_.front().name : o_.from;
    if (o_.from.empty())
      fmt::print(stderr, "laterna: note: the scene has no camera: looking from where {} was taken\n", from);
    const int index = index_of(all_, from);
    if (index < 0) return tl::unexpected(no_photograph(all_, "--from", from));
    const Photograph& photograph = all_[static_cast<std::size_t>(index)];
    View view{photograph.pose, photograph.projection};
    if (!o_.view.size.empty()) return with_aspect(view, static_cast<double>(size_.width) / size_.height);
    const Picture& picture = renderer.scene().pictures[static_cast<std::size_t>(photograph.picture)];
    if (picture.pixels != nullptr) {
      size_ = {picture.pixels->width(), picture.pixels->height()};
    } else {
      const Result<ImageHeader> header = read_image_header(picture.file);
      if (!header) return tl::unexpected(header.error());
      size_ = {header->width, header->height};
    }
    return view;
  }

  Result<void> draw_one(const Renderer& renderer) {
    const Result<View> view = find_view(renderer);
    if (!view) return tl::unexpected(view.error());
    RenderSettings settings = settings_for(size_);
    const bool is_layer_wanted =
        std::ranges::find(settings.layers, Layer::photographs) != settings.layers.end();
    if (!is_layer_wanted) settings.layers.push_back(Layer::photographs);
    Result<LayeredImage> image = renderer.render(*view, settings, progress_line("rendering"));
    if (!image) return tl::unexpected(image.error());
    tell_seen(*image);
    if (!o_.mask.empty()) {
      if (Result<void> written = write_image(mask_of(*image), o_.mask); !written) return written;
    }
    if (!is_layer_wanted)
      std::erase_if(image->channels,
                    [](const Channel& channel) { return channel.name.starts_with("photo."); });
    ++frames_;
    return write(*image, o_.output);
  }

  Result<void> draw_frames(const Renderer& renderer) {
    std::vector<std::string> names = o_.fly;
    if (names.size() == 1 && names[0] == kAll) {
      names.clear();
      for (const Photograph& photograph : all_) names.push_back(photograph.name);
    }
    const double aspect = static_cast<double>(size_.width) / size_.height;
    std::vector<View> stops;
    for (const std::string& name : names) {
      const int index = index_of(all_, name);
      if (index < 0) return tl::unexpected(no_photograph(all_, "--fly", name));
      const Photograph& photograph = all_[static_cast<std::size_t>(index)];
      stops.push_back(with_aspect({photograph.pose, photograph.projection}, aspect));
    }
    const RenderSettings settings = settings_for(size_);
    const Progress progress = progress_line("frames");
    for (; frames_ < o_.count; ++frames_) {
      const double along = o_.count > 1 ? static_cast<double>(frames_) / (o_.count - 1) : 0;
      const View view = view_on_path(stops, along * static_cast<double>(stops.size() - 1));
      Result<LayeredImage> image = renderer.render(view, settings);
      if (!image) return tl::unexpected(image.error());
      if (Result<void> written = write(*image, name_->with(frames_)); !written) return written;
      if (progress) progress(static_cast<double>(frames_ + 1) / o_.count);
    }
    return {};
  }

  // Pictures for the screen hold no layers.
  static Result<void> write(LayeredImage& image, const std::string& file) {
    if (!keeps_layers(file)) image.channels.resize(3);
    return write_image(image, file);
  }

  void tell_seen(const LayeredImage& image) {
    std::size_t surface = 0, unseen = 0;
    for (const float seen : image.find("photo.seen")->values) {
      surface += seen >= 0 ? 1U : 0U;
      unseen += seen == 0 ? 1U : 0U;
    }
    if (surface == 0) {
      fmt::print(stderr, "laterna: note: nothing of the scene is in the picture\n");
      return;
    }
    unseen_percent_ = 100.0 * static_cast<double>(unseen) / static_cast<double>(surface);
    fmt::print(stderr, "laterna: {:.1f} % of the surface in the picture is in no photograph\n",
               unseen_percent_);
  }

  static LayeredImage mask_of(const LayeredImage& image) {
    LayeredImage mask;
    mask.width = image.width;
    mask.height = image.height;
    mask.channels.push_back({"Y", image.find("photo.seen")->values});
    for (float& value : mask.channels[0].values) value = value > 0 ? 1.0F : 0.0F;
    return mask;
  }

  void print_json(const Scene& scene) const {
    nlohmann::json photographs = nlohmann::json::array();
    for (const Photograph& p : scene.photographs) {
      photographs.push_back(
          {{"name", p.name},
           {"gain", {p.gain.x, p.gain.y, p.gain.z}},
           {"position", {p.pose.position_ws.x, p.pose.position_ws.y, p.pose.position_ws.z}}});
    }
    nlohmann::json json = {{"output", o_.output},
                           {"size", {size_.width, size_.height}},
                           {"frames", frames_},
                           {"photographs", photographs}};
    if (o_.fly.empty()) json["unseen_percent"] = unseen_percent_;
    fmt::print("{}\n", json.dump(2));
  }

  const PhotoOptions& o_;
  ViewOptions::Size size_{};
  std::vector<Photograph> all_;       // also those that --only leaves out
  std::optional<NumberedName> name_;  // of --fly's frames
  int frames_ = 0;
  double unseen_percent_ = 0;
};

constexpr const char* kFooter =
    "\nA photograph is thrown back through its camera: surfaces that it sees take its colours, those\n"
    "that it does not see stay dark. Formats, conventions and layers: docs/photographs.md.\n"
    "\nExamples:\n"
    "  laterna photo mesh.ply --cameras sparse/ --photos images/ -o view.png --from 00003.jpg\n"
    "  laterna photo mesh.ply --up z --cameras cameras.json --photos images/ -o frame.####.png --fly all\n"
    "  laterna photo mesh.ply --cameras cameras.yml --photos . -o view.png --mask seen.png\n";

void declare_blending(CLI::App& command, PhotoOptions& o) {
  command
      .add_option("--visibility", o.visibility,
                  "what finds the surfaces that a photograph sees: exact, map or raytraced")
      ->check(CLI::IsMember({"exact", "map", "raytraced"}))
      ->capture_default_str();
  command
      .add_option("--blend", o.blend,
                  "surface: by angle and resolution; view: also by how near a photograph's direction is to "
                  "the picture's")
      ->check(CLI::IsMember({"surface", "view"}))
      ->capture_default_str();
  command
      .add_option("--feather", o.feather, "width of seams, a share of a photograph's longer side; 0: hard")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  command.add_option("--unseen", o.unseen, "R,G,B, linear, of surfaces that no photograph sees")
      ->capture_default_str();
  command.add_flag("--lit", o.is_lit, "the scene's lights shine on the photographs' colours");
  command.add_flag("--keep-exposure", o.keeps_exposure, "photographs as bright as they are, not evened out");
}

}  // namespace

void declare_photo(CLI::App& app, Run& run) {
  auto options = std::make_shared<PhotoOptions>();
  PhotoOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("photo", "throw photographs back on a mesh, and look from elsewhere");
  command->footer(kFooter);
  o.scene.declare_scene(*command);
  command
      ->add_option("--cameras", o.cameras,
                   "COLMAP text (file or folder), glTF, OpenCV JSON or YAML, or a folder of .cam files")
      ->required();
  command->add_option("--photos", o.photos, "folder of the photographs")->required();
  command->add_option("-o,--output", o.output, "picture to write; frame.####.png with --fly")->required();
  command->add_option("--from", o.from, "look from where this photograph was taken, at its size");
  command->add_option("--camera", o.view.camera, "camera of the scene or a rig by name");
  o.view.size.clear();
  command->add_option("--size", o.view.size,
                      "width x height in pixels; 1280x720, with --from the photograph's");
  command
      ->add_option("--fly", o.fly,
                   "photographs by comma, or all: a way through their cameras, as numbered frames")
      ->allow_extra_args(false)
      ->delimiter(',');
  command->add_option("--count", o.count, "pictures on the way of --fly, numbered from 0")
      ->check(CLI::Range(1, kMostFrames))
      ->capture_default_str();
  command->add_option("--only", o.only, "photographs by comma: the others are left out")
      ->allow_extra_args(false)
      ->delimiter(',');
  command->add_option("--mask", o.mask, "picture to write: white where any photograph sees the surface");
  command->add_option("--samples", o.samples, "per pixel: 1, 2, 4, 8 or 16")
      ->check(CLI::IsMember({1, 2, 4, 8, 16}))
      ->capture_default_str();
  std::vector<std::string> layers = {kAll};
  for (const LayerDescription& layer : list_layers()) layers.emplace_back(layer.name);
  command->add_option("--layers", o.layers, "further channels of an .exr, by comma, such as photographs")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::IsMember(layers));
  declare_blending(*command, o);
  command->add_flag("--skip-missing", o.skips_missing,
                    "leave out photographs without a camera, and cameras without a photograph");
  o.scene.declare_machine(*command);
  command->add_flag("--json", o.json, "print what was done, to standard output");
  command->callback([options, &run] { run = [options] { return PhotoCommand(*options).run(); }; });
}

}  // namespace laterna::app
