// From a scene to one whose surfaces hold its light: layout, receivers, light, pictures.
#include "laterna/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "bake/bake_notes.h"
#include "bake/baked_pages.h"
#include "bake/bounced_light.h"
#include "bake/environment_irradiance.h"
#include "bake/light_map_layout.h"
#include "bake/luxel_padding.h"
#include "bake/luxel_surfaces.h"
#include "bake/own_frame.h"
#include "bake/page_light.h"
#include "bake/part_files.h"
#include "bake/seams.h"
#include "bake/seen_light.h"
#include "bake/still_meshes.h"
#include "base/refuse.h"
#include "base/stopwatch.h"
#include "base/without_exceptions.h"
#include "render/environment.h"
#include "render/scene_defaults.h"
#include "render/settings_check.h"
#include "scene/gltf_writer.h"

namespace laterna {
namespace bake {
namespace {

// ---------------------------------------------------------------------------------------------- what is asked for

Result<void> check(const BakeSettings& s) {
  const auto whole = [](const char* name, int value, int least, int most) -> Result<void> {
    if (value >= least && value <= most) return {};
    return refuse(fmt::format("{}: expected {} to {}, got {}", name, least, most, value));
  };
  if (!(s.density >= kLeastLuxelDensity && s.density <= kMostLuxelDensity))
    return refuse(fmt::format("density: expected {:g} to {:g} luxels per metre, got {}", kLeastLuxelDensity,
                              kMostLuxelDensity, s.density));
  for (const Result<void>& checked :
       {whole("max_size", s.max_size, kLeastLightMapSide, kMostLightMapSide),
        whole("padding", s.padding, 1, kMostLuxelPadding), whole("samples", s.samples, 1, kMostLuxelSamples),
        whole("light_samples", s.light_samples, 1, kMaxAccumulated),
        whole("occlusion_rays", s.occlusion_rays, 0, kMostOcclusionRays)}) {
    if (!checked) return checked;
  }
  if (!(s.occlusion_distance > 0))
    return refuse(
        fmt::format("occlusion_distance: expected metres greater than 0, got {}", s.occlusion_distance));
  if (!(s.exposure >= 0 && std::isfinite(s.exposure)))
    return refuse(fmt::format("exposure: expected a factor of 0 (automatic) or more, got {}", s.exposure));
  if (s.into == BakeInto::emissive && s.keep_lights)
    return refuse(
        "keep_lights: surfaces that show their light by emissive textures reflect none: lights cannot shine "
        "on them as well. "
        "Bake into light maps, or let the lights go");
  return render::check_options(s.options);
}

// Lights that will be in the light maps are on, others off.
Result<std::vector<bool>> choose_lights(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<bool> is_chosen(scene.lights.size(), false);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    is_chosen[i] = names.empty() && light.enabled && light.blend == BlendMode::add;
  }
  for (const std::string& name : names) {
    const auto found = std::ranges::find(scene.lights, name, &Light::name);
    if (found == scene.lights.end()) return refuse(fmt::format("the scene has no light \"{}\"", name));
    if (found->blend != BlendMode::add)
      return refuse(fmt::format("light \"{}\" does more than add its light: it cannot be baked", name));
    is_chosen[static_cast<std::size_t>(found - scene.lights.begin())] = true;
  }
  return is_chosen;
}

// Surfaces that show their light reflect no other.
Result<void> check_lights_left(const Scene& scene, const std::vector<bool>& is_chosen) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (is_chosen[i] || !light.enabled || light.blend != BlendMode::add) continue;
    return refuse(
        fmt::format("light \"{}\" is on, and not among those to be baked: surfaces that show their light by "
                    "emissive textures "
                    "would reflect none of it. Bake it too, turn it off, or bake into light maps",
                    light.name));
  }
  return {};
}

void warn_of_lights_left(Scene& scene, BakeInto into) {
  for (const Light& light : scene.lights) {
    if (!light.enabled || light.blend == BlendMode::add) continue;
    scene.warnings.push_back({{},
                              fmt::format("light \"{}\"", light.name),
                              into == BakeInto::light_maps
                                  ? "does more than add its light: it is not baked, and stays"
                                  : "does more than add its light: it is not baked, and what is reflects "
                                    "nothing of it"});
  }
}

class Baker {
 public:
  Baker(Scene scene, const BakeSettings& settings, const Progress& progress)
      : scene_(std::move(scene)),
        settings_(settings),
        progress_callback_(progress),
        pool_(settings.options.threads),
        set_(settings.options.instruction_set.value_or(best_instruction_set())) {}

  Result<BakedScene> run() {
    Stopwatch watch;
    watch.start();
    Result<std::vector<bool>> chosen = choose_lights(scene_, settings_.lights);
    if (!chosen) return tl::unexpected(std::move(chosen.error()));
    is_baked_ = std::move(*chosen);
    if (settings_.into == BakeInto::emissive) {
      if (Result<void> checked = check_lights_left(scene_, is_baked_); !checked)
        return tl::unexpected(std::move(checked.error()));
    }
    begin(BakeStage::layout);
    prepare();
    Result<LightMapLayout> layout = lay_out(scene_, settings_);
    if (!layout) return tl::unexpected(std::move(layout.error()));
    layout_ = std::move(*layout);
    report_.layout_ms = watch.lap_ms();
    if (Result<void> lit = light(); !lit) return tl::unexpected(with_parts(std::move(lit.error())));
    finish();
    report_.light_ms = watch.lap_ms();
    return BakedScene{std::move(scene_), std::move(report_)};
  }

 private:
  void begin(BakeStage stage) const {
    if (settings_.stage_begins) settings_.stage_begins(stage);
  }

  void prepare() {
    if (settings_.lights.empty()) warn_of_lights_left(scene_, settings_.into);
    note_what_is_lost(scene_, is_baked_, settings_);
    if (!scene_.clips.empty()) {
      scene_.clips.clear();
      scene_.warnings.push_back({{}, "clips", "light maps hold one instant: animation is left out"});
    }
    for (const std::string& name : stand_still(scene_))
      scene_.warnings.push_back(
          {{},
           fmt::format("object \"{}\"", name),
           fmt::format("wears a skin or morphs: baked as it stands at {:g} s, and so it stays",
                       settings_.options.time)});
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      was_enabled_.push_back(scene_.lights[i].enabled);
      scene_.lights[i].enabled = is_baked_[i];
      if (is_baked_[i]) report_.lights.push_back(scene_.lights[i].name);
    }
  }

  // Of all that decides what a luxel holds: the scene as a file would have it, and the settings of light.
  [[nodiscard]] Result<image::ContentKey> key() const {
    image::ContentKey key;
    if (settings_.work_file.empty()) return key;
    const Result<GltfFiles> files = make_gltf(scene_, "key.glb", {});
    if (!files) return tl::unexpected(files.error());
    for (const gltf::BesideFile& file : files->files) key.add(std::span<const std::byte>(file.bytes));
    for (const int number : {settings_.samples, settings_.light_samples, settings_.occlusion_rays})
      key.add(static_cast<std::uint64_t>(number));
    for (const double number : {settings_.density, settings_.occlusion_distance, settings_.options.time})
      key.add(std::as_bytes(std::span(&number, 1)));
    return key;
  }

  Result<void> light() {
    Result<std::unique_ptr<OwnFrame>> own = make_frame(scene_, settings_.options.time, set_, pool_);
    if (!own) return tl::unexpected(std::move(own.error()));
    const frame::Frame* frame = &(*own)->frame;
    note_small_scene(scene_, layout_.used, frame->bounds, settings_.density);
    const Result<image::ContentKey> content = key();
    if (!content) return tl::unexpected(content.error());
    files_ = PartFiles(settings_.work_file, *content, settings_.resume);
    const auto rays = std::make_shared<const trace::RayScene>(*frame);
    const DirectLight direct(*frame, rays, settings_.light_samples, set_);
    const OcclusionRays occlusion(*rays, settings_.occlusion_rays, settings_.occlusion_distance);
    std::size_t steps = 0;
    for (const LightMapPage& page : layout_.pages) steps += tiles_of(page.size);
    const double direct_part = direct_part_of_work(direct.light_count());
    const Progress direct_progress = part_of_progress(0, direct_part);
    render::ProgressReport progress(direct_progress, steps);
    begin(BakeStage::direct_light);
    for (std::size_t page = 0; page < layout_.pages.size(); ++page) {
      triangles_.push_back(
          std::make_unique<PageTriangles>(*frame, materials_of(page), layout_.pages[page].size));
      const PageContext context = {*frame,
                                   *rays,
                                   *triangles_.back(),
                                   direct,
                                   settings_.occlusion_rays > 0 ? &occlusion : nullptr,
                                   {settings_.samples, 1 / settings_.density},
                                   pool_,
                                   progress};
      light_page(page, context);
      if (progress.is_cancelled())
        return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
    }
    if (settings_.interreflection) {
      begin(BakeStage::reflected_light);
      if (Result<void> added = add_bounces(*frame, rays, part_of_progress(direct_part, 1)); !added)
        return added;
    }
    const bool is_shown = settings_.into == BakeInto::emissive;
    if (is_shown) {
      if (Result<void> shown = show(*frame, rays); !shown) return shown;
    }
    if (settings_.join_seams) join_all(**own);
    if (is_shown) report_.exposure = encode_pages(pages_, settings_.exposure);
    continue_all();
    report_parts();
    return {};
  }

  void report_parts() {
    const PartFiles::Tally& tally = files_.tally();
    report_.parts = tally.asked;
    report_.resumed_parts = tally.found;
    if (!tally.not_kept) return;
    Diagnostic note = tally.not_kept->diagnostics.front();
    note.message +=
        ": parts that were finished were not kept, and a run that is stopped could not go on from there";
    scene_.warnings.push_back(std::move(note));
  }

  Result<void> show(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays) {
    const Result<std::optional<EnvironmentIrradiance>> environment = environment_irradiance();
    if (!environment) return tl::unexpected(environment.error());
    const double side = 1 / settings_.density;
    const LuxelSurfaces surfaces(frame, rays, side / settings_.samples, set_);
    const Showing showing = {
        scene_.ambient, *environment ? &**environment : nullptr, {settings_.samples, side}};
    show_surfaces({frame, *rays, surfaces, pool_}, triangles_, showing, pages_);
    return {};
  }

  [[nodiscard]] Result<std::optional<EnvironmentIrradiance>> environment_irradiance() const {
    if (!scene_.environment) return std::optional<EnvironmentIrradiance>();
    const Environment& environment = *scene_.environment;
    if (environment.irradiance) return EnvironmentIrradiance(environment, *environment.irradiance);
    const Result<image::EnvironmentMap> map = render::prepare_environment(
        scene_, pool_, set_, settings_.options.environment_cache, settings_.options.environment_progress);
    if (!map) return tl::unexpected(map.error());
    return EnvironmentIrradiance(environment, map->irradiance);
  }

  // One who stops a bake wants to know whether it can go on.
  [[nodiscard]] Error with_parts(Error error) const {
    if (error.failure != Failure::cancelled) return error;
    const std::size_t parts = files_.tally().found + files_.tally().kept;
    error.diagnostics.front().message =
        parts == 0 ? std::string("no part was finished that could be resumed")
                   : fmt::format("{} finished {} beside {}, to be resumed", parts,
                                 parts == 1 ? "part lies" : "parts lie", settings_.work_file.string());
    return error;
  }

  // By the number of rays for each luxel.
  [[nodiscard]] double direct_part_of_work(std::size_t lights) const {
    if (!settings_.interreflection) return 1;
    const double direct = settings_.samples * settings_.samples *
                          static_cast<double>(lights + static_cast<std::size_t>(settings_.occlusion_rays));
    // What rays meet is looked up as well.
    const double reflected = 4.0 * settings_.interreflection->rays;
    return direct / (direct + reflected);
  }

  // Empty where nobody asks.
  [[nodiscard]] Progress part_of_progress(double from, double to) const {
    if (!progress_callback_) return {};
    return [this, from, to](double done) { return progress_callback_(from + (to - from) * done); };
  }

  Result<void> add_bounces(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays,
                           const Progress& progress) {
    const double side = 1 / settings_.density;
    const LuxelSurfaces surfaces(frame, rays, side, set_);
    std::vector<LitPage> lit;
    for (std::size_t i = 0; i < pages_.size(); ++i)
      lit.push_back({triangles_[i].get(), pages_[i].front.get(), pages_[i].back.get()});
    const Result<BouncedLight> bounced = add_bounced_light(
        frame, *rays, lit, surfaces, side, *settings_.interreflection, pool_, progress, files_);
    if (!bounced) return tl::unexpected(bounced.error());
    report_.bounces = bounced->bounces;
    return {};
  }

  void light_page(std::size_t page, const PageContext& context) {
    const glm::ivec2 size = layout_.pages[page].size;
    BakedPage& pictures = pages_.emplace_back();
    pictures.front = std::make_shared<Image>(size.x, size.y, 3, PixelType::f32, Transfer::linear);
    if (layout_.pages[page].has_back)
      pictures.back = std::make_shared<Image>(size.x, size.y, 3, PixelType::f32, Transfer::linear);
    if (context.occlusion != nullptr)
      pictures.occlusion = std::make_shared<Image>(size.x, size.y, 1, PixelType::u8, Transfer::linear);
    pictures.is_found.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    std::size_t row = 0;
    for (std::size_t strip = 0; strip < strip_count(size) && !context.progress.is_cancelled(); ++strip) {
      StripValues values(strip_size(size, strip), layout_.pages[page].has_back, context.occlusion != nullptr);
      const PartFiles::Values bytes = {std::as_writable_bytes(std::span(values.numbers))};
      const std::string part = fmt::format("{}-{}", page, strip);
      if (files_.find(part, bytes)) {
        context.progress.advance(tiles_of(values.size));
      } else {
        light_strip(context, strip, values);
        if (context.progress.is_cancelled()) return;
        files_.keep(part, bytes);
      }
      store(values, row, pictures);
      row += static_cast<std::size_t>(values.size.y);
    }
  }

  static std::size_t tiles_of(glm::ivec2 luxels) {
    const glm::ivec2 tiles = (luxels + kTileSide - 1) / kTileSide;
    return static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
  }

  void store(const StripValues& values, std::size_t row, BakedPage& pictures) {
    const auto first = static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(values.size.x));
    std::ranges::copy(values.front, pictures.front->values<float>().begin() + 3 * first);
    if (pictures.back != nullptr)
      std::ranges::copy(values.back, pictures.back->values<float>().begin() + 3 * first);
    for (std::size_t i = 0; i < values.openness.size(); ++i)
      pictures.occlusion->values<std::uint8_t>()[static_cast<std::size_t>(first) + i] =
          static_cast<std::uint8_t>(values.openness[i] * 255.0F + 0.5F);
    for (std::size_t i = 0; i < values.is_found.size(); ++i)
      pictures.is_found[static_cast<std::size_t>(first) + i] = values.is_found[i] > 0 ? 1 : 0;
    report_.lit_luxels += static_cast<std::size_t>(std::ranges::count(values.is_found, 1.0F));
  }

  void join_all(const OwnFrame& own) {
    const frame::TriangleNeighbours neighbours = frame::place_neighbours(
        std::make_shared<const frame::MeshNeighbours>(frame::find_mesh_neighbours(scene_, own.meshes, pool_)),
        scene_, own.meshes);
    for (std::size_t page = 0; page < pages_.size(); ++page) {
      const std::vector<SeamPoint> seams =
          find_seams(own.frame, neighbours, materials_of(page), layout_.pages[page].size);
      std::vector<Image*> pictures = {pages_[page].front.get()};
      if (pages_[page].back != nullptr) pictures.push_back(pages_[page].back.get());
      join_seams(seams, pictures);
    }
  }

  // Whether materials are on a page, and glTF's default material, which is on none.
  [[nodiscard]] std::vector<bool> materials_of(std::size_t page) const {
    std::vector<bool> is_on_page;
    is_on_page.reserve(layout_.page_of_material.size() + 1);
    for (const int other : layout_.page_of_material) is_on_page.push_back(other == static_cast<int>(page));
    is_on_page.push_back(false);
    return is_on_page;
  }

  void continue_all() {
    for (const BakedPage& page : pages_) {
      std::vector<Image*> pictures;
      for (Image* picture : {page.front.get(), page.back.get(), page.occlusion.get()}) {
        if (picture != nullptr) pictures.push_back(picture);
      }
      report_.padding_luxels += continue_surfaces(pictures, page.is_found, settings_.padding);
    }
  }

  void finish() {
    fill_report();
    if (settings_.into == BakeInto::emissive) {
      show_as_emission(scene_, layout_, pages_);
      expose(scene_, layout_, report_.exposure);
    } else {
      show_as_light_maps(scene_, layout_, pages_);
    }
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) scene_.lights[i].enabled = was_enabled_[i];
    if (!settings_.keep_lights) remove_lights(scene_, is_baked_);
    scene_.ambient_is_set = true;  // or a scene without lights would be given a sun
  }

  void fill_report() {
    for (const LightMapPage& page : layout_.pages) {
      report_.pages.push_back({page.size.x, page.size.y, page.has_back});
      const auto luxels = static_cast<std::size_t>(page.size.x) * static_cast<std::size_t>(page.size.y);
      report_.luxels += luxels;
      const std::size_t of_color = settings_.into == BakeInto::emissive ? 3 : 12;
      const bool has_occlusion = settings_.occlusion_rays > 0 && settings_.into == BakeInto::light_maps;
      report_.bytes += luxels * ((page.has_back ? 2 : 1) * of_color + (has_occlusion ? 1 : 0));
    }
    report_.surfaces = layout_.surfaces;
    report_.charts = layout_.charts;
    report_.used = layout_.used;
    report_.least_density = layout_.least_density;
    report_.greatest_density = layout_.greatest_density;
    report_.thin_triangles = layout_.thin_triangles;
  }

  Scene scene_;
  const BakeSettings& settings_;
  const Progress& progress_callback_;
  TaskPool pool_;
  InstructionSet set_;
  std::vector<bool> is_baked_, was_enabled_;  // by light
  LightMapLayout layout_;
  std::vector<std::unique_ptr<PageTriangles>> triangles_;  // by page
  std::vector<BakedPage> pages_;
  PartFiles files_ = PartFiles::none();
  BakeReport report_;
};

}  // namespace
}  // namespace bake

Result<BakedScene> bake_light(Scene scene, const BakeSettings& settings, const Progress& progress) {
  if (Result<void> checked = bake::check(settings); !checked)
    return tl::unexpected(std::move(checked.error()));
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty())
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  // The lights that a light map holds are no longer in the scene: a new one in its place would lose them.
  for (const Material& material : scene.materials) {
    if (!material.light_map.front.is_set()) continue;
    return refuse(
        fmt::format("material \"{}\" has a light map already: bake the scene that it was baked from, with "
                    "all lights at once",
                    material.name));
  }
  return without_exceptions(
      Error(Failure::bad_input, Diagnostic{{}, {}, "not enough memory to bake the scene"}),
      [&]() -> Result<BakedScene> {
        render::add_default_light(scene);
        return bake::Baker(std::move(scene), settings, progress).run();
      });
}

}  // namespace laterna
