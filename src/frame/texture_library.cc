#include "frame/texture_library.h"

#include <algorithm>
#include <compare>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "frame/decode_picture.h"
#include "frame/surface_lobes.h"
#include "image/film.h"

namespace laterna::frame {
namespace {

using Request = std::pair<int, image::MipUse>;

std::set<Request> requests(const Scene& scene) {
  std::set<Request> all;
  const auto want = [&](const Texture& texture, image::MipUse use) {
    if (texture.is_set()) all.insert({texture.picture, use});
  };
  for (const Material& m : scene.materials) {
    want(m.base_color_texture, base_color_use(m));
    want(m.metallic_roughness_texture, image::MipUse::data);
    want(m.normal_texture, image::MipUse::data);
    want(m.occlusion_texture, image::MipUse::data);
    want(m.emissive_texture, image::MipUse::colour);
    want(m.light_map.front, image::MipUse::data);
    want(m.light_map.back, image::MipUse::data);
    for (std::size_t i = 0; m.lobes != nullptr && i < kLobeTextures; ++i)
      want(*textures_of(*m.lobes)[i], kLobeTextureUses[i]);
    for (const SurfaceLayer& layer : m.layers) {
      want(layer.texture, kLayerUse);
      if (layer.projector < 0) continue;
      const int slide = scene.lights[static_cast<std::size_t>(layer.projector)].slide;
      if (slide >= 0) all.insert({slide, kLayerUse});
    }
  }
  for (const Light& light : scene.lights) {
    if (light.slide >= 0) all.insert({light.slide, slide_use(light)});
  }
  for (const Photograph& photograph : scene.photographs)
    all.insert({photograph.picture, image::MipUse::colour_with_alpha});
  return all;
}

// How long decoding takes goes with this; 0 where nothing has to be decoded, or nothing can be.
std::uintmax_t encoded_bytes(const Picture& picture) {
  if (picture.pixels != nullptr) return 0;
  if (!picture.encoded.empty()) return picture.encoded.size();
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(picture.file, ignored);
  return ignored ? 0 : size;
}

}  // namespace

bool has_relief(const Material& material) {
  return material.relief != nullptr && material.relief->texture.is_set() && material.relief->depth > 0;
}

image::MipUse base_color_use(const Material& material) {
  return material.alpha_mode == AlphaMode::opaque ? image::MipUse::colour : image::MipUse::colour_with_alpha;
}

image::MipUse slide_use(const Light& light) {
  return light.slide_is_intensity ? image::MipUse::data : image::MipUse::colour;
}

Result<TextureLibrary> TextureLibrary::load(const Scene& scene, const TaskPool& pool, InstructionSet set) {
  TextureLoading loading(scene, set);
  pool.for_each(loading.task_count(), [&](std::size_t task, int) { loading.run(task); });
  return loading.finish();
}

TextureLoading::TextureLoading(const Scene& scene, InstructionSet set, double scene_time)
    : scene_(scene), set_(set), scene_time_(scene_time) {
  for (const Request& request : requests(scene)) {
    const auto [index, use] = request;
    if (pictures_.empty() || pictures_.back().index != index) {
      pictures_.push_back(
          {index, {}, {}, encoded_bytes(scene.pictures[static_cast<std::size_t>(index)]), {}});
    }
    pictures_.back().uses.push_back(use);
    if (scene.pictures[static_cast<std::size_t>(index)].film) {
      library_.films_[index] = {};
    } else {
      library_.chains_[request] = nullptr;
    }
  }
  add_reliefs();
  // Else a thread might end with the largest picture alone.
  std::stable_sort(pictures_.begin(), pictures_.end(),
                   [](const auto& a, const auto& b) { return a.encoded_bytes > b.encoded_bytes; });
}

void TextureLoading::add_reliefs() {
  for (const Material& material : scene_.materials) {
    if (!has_relief(material)) continue;
    const Relief& relief = *material.relief;
    const TextureLibrary::ReliefUse use = {relief.kind, relief.texture.sampler.wrap_u,
                                           relief.texture.sampler.wrap_v};
    if (library_.reliefs_.emplace(std::pair(relief.texture.picture, use), nullptr).second)
      picture_at(relief.texture.picture).relief_uses.push_back(use);
  }
}

TextureLoading::UsedPicture& TextureLoading::picture_at(int index) {
  const auto known = std::find_if(pictures_.begin(), pictures_.end(),
                                  [&](const UsedPicture& used) { return used.index == index; });
  if (known != pictures_.end()) return *known;
  return pictures_.emplace_back(
      UsedPicture{index, {}, {}, encoded_bytes(scene_.pictures[static_cast<std::size_t>(index)]), {}});
}

void TextureLoading::make_reliefs(UsedPicture& used, const Image& picture) {
  const auto samples = std::int64_t{picture.width()} * picture.height();
  if (!used.relief_uses.empty() && samples > kMaxReliefSamples) {
    const Picture& of_scene = scene_.pictures[static_cast<std::size_t>(used.index)];
    used.faults.push_back({of_scene.name.empty() ? of_scene.file.string() : of_scene.name,
                           {},
                           "a relief has at most " + std::to_string(kMaxReliefSamples) +
                               " samples (8192 x 8192), this one has " + std::to_string(picture.width()) +
                               " x " + std::to_string(picture.height())});
    return;
  }
  for (const TextureLibrary::ReliefUse& use : used.relief_uses) {
    library_.reliefs_.at({used.index, use}) =
        std::make_shared<const ReliefField>(picture, use.kind, Sampler{use.wrap_u, use.wrap_v});
  }
}

void TextureLoading::run(std::size_t task) {
  UsedPicture& used = pictures_[task];
  const Picture& picture = scene_.pictures[static_cast<std::size_t>(used.index)];
  if (picture.film) {
    open_film(used, picture);
    return;
  }
  Result<std::shared_ptr<const Image>> pixels = decode_picture(picture);
  if (!pixels) {
    used.faults = std::move(pixels.error().diagnostics);
    return;
  }
  for (const image::MipUse use : used.uses) {
    library_.chains_.at({used.index, use}) =
        std::make_unique<image::MipChain>(image::make_mip_chain(**pixels, use, set_));
  }
  make_reliefs(used, **pixels);
}

void TextureLoading::open_film(UsedPicture& used, const Picture& picture) {
  auto film = image::Film::open(picture.file, *picture.film, used.uses, set_);
  if (!film) {
    used.faults = std::move(film.error().diagnostics);
    return;
  }
  Result<std::shared_ptr<const image::FilmFrame>> frame = (*film)->at(scene_time_);
  if (!frame) {
    used.faults = std::move(frame.error().diagnostics);
    return;
  }
  library_.films_.at(used.index) = {std::move(*film), std::move(*frame)};
}

Result<TextureLibrary> TextureLoading::finish() {
  // In the scene's order, whatever was decoded first.
  std::sort(pictures_.begin(), pictures_.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  Error error;
  for (UsedPicture& picture : pictures_) {
    for (Diagnostic& fault : picture.faults) error.diagnostics.push_back(std::move(fault));
  }
  if (!error.diagnostics.empty()) return tl::unexpected(std::move(error));
  for (const auto& [index, shown] : library_.films_) {
    const std::vector<Diagnostic>& warnings = shown.film->warnings();
    library_.warnings_.insert(library_.warnings_.end(), warnings.begin(), warnings.end());
  }
  return std::move(library_);
}

const image::MipChain* TextureLibrary::find(int picture, image::MipUse use) const {
  if (const auto film = films_.find(picture); film != films_.end()) {
    const auto chain = film->second.frame->chains.find(use);
    return chain == film->second.frame->chains.end() ? nullptr : &chain->second;
  }
  const auto found = chains_.find({picture, use});
  return found == chains_.end() ? nullptr : found->second.get();
}

const ReliefField* TextureLibrary::find_relief(const Relief& relief) const {
  const ReliefUse use = {relief.kind, relief.texture.sampler.wrap_u, relief.texture.sampler.wrap_v};
  const auto found = reliefs_.find({relief.texture.picture, use});
  return found == reliefs_.end() ? nullptr : found->second.get();
}

Result<int> TextureLibrary::show(double scene_time) {
  std::map<int, std::shared_ptr<const image::FilmFrame>> frames;
  Error error;
  for (const auto& [index, shown] : films_) {
    auto frame = shown.film->at(scene_time);
    if (frame) {
      frames.emplace(index, std::move(*frame));
    } else {
      std::move(frame.error().diagnostics.begin(), frame.error().diagnostics.end(),
                std::back_inserter(error.diagnostics));
    }
  }
  if (!error.diagnostics.empty()) return tl::unexpected(std::move(error));
  int changed = 0;
  for (auto& [index, frame] : frames) {
    ShownFilm& shown = films_.at(index);
    if (frame->number == shown.frame->number) continue;
    shown.frame = std::move(frame);
    ++changed;
  }
  return changed;
}

}  // namespace laterna::frame
