// From a scene to one whose surfaces hold its light: layout, receivers, light, pictures.
#include "laterna/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "bake/bake_notes.h"
#include "bake/bounced_light.h"
#include "bake/light_map_layout.h"
#include "bake/own_frame.h"
#include "bake/page_light.h"
#include "bake/strip_files.h"
#include "base/refuse.h"
#include "base/stopwatch.h"
#include "base/without_exceptions.h"
#include "frame/place_lights.h"
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

void warn_of_lights_left(Scene& scene) {
  for (const Light& light : scene.lights) {
    if (light.enabled && light.blend != BlendMode::add)
      scene.warnings.push_back({{},
                                fmt::format("light \"{}\"", light.name),
                                "does more than add its light: it is not baked, and stays"});
  }
}

// ---------------------------------------------------------------------------------------------- what comes out

constexpr Sampler kLuxels = {Wrap::clamp, Wrap::clamp, Filter::linear, Filter::linear, MipFilter::none};

Texture texture_of(int picture) {
  Texture texture;
  texture.picture = picture;
  texture.sampler = kLuxels;
  texture.uv_set = 1;
  return texture;
}

struct PagePictures {
  std::shared_ptr<Image> front, back, occlusion;
};

int add_picture(Scene& scene, std::string name, std::shared_ptr<const Image> pixels) {
  if (pixels == nullptr) return -1;
  Picture picture;
  picture.name = std::move(name);
  picture.pixels = std::move(pixels);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

// Lights that were baked are taken out, unless surfaces show their slides as paint: these stay, and are off.
void remove_lights(Scene& scene, const std::vector<bool>& is_baked) {
  const std::vector<int> decals = frame::decal_lights(scene);
  std::vector<int> new_index(scene.lights.size(), -1);
  std::vector<Light> kept;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const bool is_paint = std::ranges::find(decals, static_cast<int>(i)) != decals.end();
    if (is_baked[i] && !is_paint) continue;
    if (is_baked[i]) scene.lights[i].enabled = false;
    new_index[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(scene.lights[i]));
  }
  scene.lights = std::move(kept);
  const auto renumber = [&](int& light) {
    if (light >= 0) light = new_index[static_cast<std::size_t>(light)];
  };
  for (Node& node : scene.nodes) renumber(node.light);
  for (Material& material : scene.materials) {
    for (SurfaceLayer& layer : material.layers) renumber(layer.projector);
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
    prepare();
    Result<LightMapLayout> layout = lay_out(scene_, settings_);
    if (!layout) return tl::unexpected(std::move(layout.error()));
    layout_ = std::move(*layout);
    report_.layout_ms = watch.lap_ms();
    if (Result<void> lit = light(); !lit) return tl::unexpected(std::move(lit.error()));
    finish();
    report_.light_ms = watch.lap_ms();
    return BakedScene{std::move(scene_), std::move(report_)};
  }

 private:
  void prepare() {
    if (settings_.lights.empty()) warn_of_lights_left(scene_);
    warn_of_what_is_not_baked(scene_);
    if (!scene_.clips.empty()) {
      scene_.clips.clear();
      scene_.warnings.push_back({{}, "clips", "light maps hold one instant: animation is left out"});
    }
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
    for (const int number :
         {settings_.samples, settings_.light_samples, settings_.occlusion_rays, settings_.padding})
      key.add(static_cast<std::uint64_t>(number));
    for (const double number : {settings_.density, settings_.occlusion_distance, settings_.options.time})
      key.add(std::as_bytes(std::span(&number, 1)));
    return key;
  }

  Result<void> light() {
    Result<std::unique_ptr<OwnFrame>> own = make_frame(scene_, settings_.options.time, set_, pool_);
    if (!own) return tl::unexpected(std::move(own.error()));
    const frame::Frame* frame = &(*own)->frame;
    const Result<image::ContentKey> content = key();
    if (!content) return tl::unexpected(content.error());
    StripFiles files(settings_.work_file, *content, settings_.resume);
    const auto rays = std::make_shared<const trace::RayScene>(*frame);
    const DirectLight direct(*frame, rays, settings_.light_samples, set_);
    const OcclusionRays occlusion(*rays, settings_.occlusion_rays, settings_.occlusion_distance);
    std::size_t steps = 0;
    for (const LightMapPage& page : layout_.pages) {
      const glm::ivec2 tiles = (page.size + kTileSide - 1) / kTileSide;
      steps += static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
    }
    const double direct_part = settings_.interreflection ? kDirectPart : 1;
    const Progress direct_progress = part_of_progress(0, direct_part);
    render::ProgressReport progress(direct_progress, steps);
    std::vector<std::unique_ptr<PageTriangles>> pages;
    for (std::size_t page = 0; page < layout_.pages.size(); ++page) {
      std::vector<bool> is_on_page;
      for (const int other : layout_.page_of_material) is_on_page.push_back(other == static_cast<int>(page));
      is_on_page.push_back(false);  // glTF's default material
      pages.push_back(
          std::make_unique<PageTriangles>(*frame, is_on_page, layout_.pages[page].size, settings_.padding));
      const PageContext context = {*frame,
                                   *rays,
                                   *pages.back(),
                                   direct,
                                   settings_.occlusion_rays > 0 ? &occlusion : nullptr,
                                   {settings_.samples, 1 / settings_.density},
                                   pool_,
                                   progress};
      light_page(page, context, files);
      if (progress.is_cancelled())
        return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
    }
    if (settings_.interreflection) {
      if (Result<void> added = add_bounces(*frame, *rays, pages, part_of_progress(direct_part, 1)); !added)
        return added;
    }
    files.remove();
    return {};
  }

  // Of the whole work, roughly, where there is interreflection.
  static constexpr double kDirectPart = 0.3;

  // Empty where nobody asks.
  [[nodiscard]] Progress part_of_progress(double from, double to) const {
    if (!progress_callback_) return {};
    return [this, from, to](double done) { return progress_callback_(from + (to - from) * done); };
  }

  Result<void> add_bounces(const frame::Frame& frame, const trace::RayScene& rays,
                           const std::vector<std::unique_ptr<PageTriangles>>& pages,
                           const Progress& progress) {
    std::vector<LitPage> lit;
    for (std::size_t i = 0; i < pages.size(); ++i)
      lit.push_back({pages[i].get(), pictures_[i].front.get(), pictures_[i].back.get()});
    const Result<BouncedLight> bounced = add_bounced_light(frame, rays, lit, 1 / settings_.density,
                                                           *settings_.interreflection, pool_, progress);
    if (!bounced) return tl::unexpected(bounced.error());
    report_.bounces = bounced->bounces;
    return {};
  }

  void light_page(std::size_t page, const PageContext& context, StripFiles& files) {
    const glm::ivec2 size = layout_.pages[page].size;
    PagePictures& pictures = pictures_.emplace_back();
    pictures.front = std::make_shared<Image>(size.x, size.y, 3, PixelType::f32, Transfer::linear);
    if (layout_.pages[page].has_back)
      pictures.back = std::make_shared<Image>(size.x, size.y, 3, PixelType::f32, Transfer::linear);
    if (context.occlusion != nullptr)
      pictures.occlusion = std::make_shared<Image>(size.x, size.y, 1, PixelType::u8, Transfer::linear);
    std::size_t row = 0;
    for (std::size_t strip = 0; strip < strip_count(size) && !context.progress.is_cancelled(); ++strip) {
      StripValues values(strip_size(size, strip), layout_.pages[page].has_back, context.occlusion != nullptr);
      ++report_.strips;
      if (files.find(page, strip, values.numbers)) {
        ++report_.resumed_strips;
        context.progress.advance(tiles_of(values.size));
      } else {
        light_strip(context, strip, values);
        if (context.progress.is_cancelled()) return;
        files.keep(page, strip, values.numbers);
      }
      store(values, row, pictures);
      row += static_cast<std::size_t>(values.size.y);
    }
  }

  static std::size_t tiles_of(glm::ivec2 luxels) {
    const glm::ivec2 tiles = (luxels + kTileSide - 1) / kTileSide;
    return static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
  }

  void store(const StripValues& values, std::size_t row, PagePictures& pictures) {
    const std::size_t first = row * static_cast<std::size_t>(values.size.x);
    std::ranges::copy(values.front,
                      pictures.front->values<float>().begin() + 3 * static_cast<std::ptrdiff_t>(first));
    if (pictures.back != nullptr)
      std::ranges::copy(values.back,
                        pictures.back->values<float>().begin() + 3 * static_cast<std::ptrdiff_t>(first));
    for (std::size_t i = 0; i < values.openness.size(); ++i)
      pictures.occlusion->values<std::uint8_t>()[first + i] =
          static_cast<std::uint8_t>(values.openness[i] * 255.0F + 0.5F);
    report_.lit_luxels += static_cast<std::size_t>(std::ranges::count(values.is_found, 1.0F));
  }

  // -------------------------------------------------------------------------------------------- the scene with its light

  void finish() {
    fill_report();
    std::vector<LightMap> maps;
    std::vector<int> occlusion;
    for (std::size_t page = 0; page < pictures_.size(); ++page) {
      PagePictures& p = pictures_[page];
      LightMap map;
      map.front = texture_of(add_picture(scene_, fmt::format("light map {}", page), std::move(p.front)));
      if (p.back != nullptr)
        map.back =
            texture_of(add_picture(scene_, fmt::format("light map {}, back", page), std::move(p.back)));
      maps.push_back(map);
      occlusion.push_back(add_picture(scene_, fmt::format("occlusion {}", page), std::move(p.occlusion)));
    }
    for (std::size_t m = 0; m < layout_.page_of_material.size(); ++m) {
      if (layout_.page_of_material[m] < 0) continue;
      const auto page = static_cast<std::size_t>(layout_.page_of_material[m]);
      Material& material = scene_.materials[m];
      material.light_map = maps[page];
      if (occlusion[page] < 0) continue;
      if (material.occlusion_texture.is_set()) {
        scene_.warnings.push_back({{},
                                   fmt::format("material \"{}\"", material.name),
                                   "has an occlusion texture of its own, which stays"});
      } else {
        material.occlusion_texture = texture_of(occlusion[page]);
      }
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
      report_.bytes += luxels * ((page.has_back ? 24U : 12U) + (settings_.occlusion_rays > 0 ? 1U : 0U));
    }
    report_.surfaces = layout_.surfaces;
    report_.charts = layout_.charts;
    report_.used = layout_.used;
    report_.least_density = layout_.least_density;
    report_.greatest_density = layout_.greatest_density;
  }

  Scene scene_;
  const BakeSettings& settings_;
  const Progress& progress_callback_;
  TaskPool pool_;
  InstructionSet set_;
  std::vector<bool> is_baked_, was_enabled_;  // by light
  LightMapLayout layout_;
  std::vector<PagePictures> pictures_;
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
