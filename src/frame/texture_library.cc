#include "frame/texture_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>

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
  }
  for (const Light& light : scene.lights) {
    if (light.slide >= 0) all.insert({light.slide, slide_use(light)});
  }
  for (const Photograph& photograph : scene.photographs)
    all.insert({photograph.picture, image::MipUse::colour_with_alpha});
  return all;
}

Result<Image> decode(const Picture& picture) {
  if (!picture.encoded.empty()) return decode_image(picture.encoded, picture.name);
  return read_image(picture.file);
}

// How long decoding takes goes with this; 0 where nothing has to be decoded, or nothing can be.
std::uintmax_t encoded_bytes(const Picture& picture) {
  if (picture.pixels != nullptr) return 0;
  if (!picture.encoded.empty()) return picture.encoded.size();
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(picture.file, ignored);
  return ignored ? 0 : size;
}

// A texel that is no number would spread over every level of the picture, and from there over what is rendered.
void check_values(const Image& image, const Picture& picture, std::vector<Diagnostic>& faults) {
  const std::span<const float> values = image.values<float>();
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  const auto pixel =
      static_cast<std::size_t>(bad - values.begin()) / static_cast<std::size_t>(image.channels());
  const auto width = static_cast<std::size_t>(image.width());
  const std::string name = picture.name.empty() ? picture.file.string() : picture.name;
  faults.push_back({name, fmt::format("pixel {}, {}", pixel % width, pixel / width),
                    fmt::format("expected finite numbers in a picture that is used, got {}", *bad)});
}

}  // namespace

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

TextureLoading::TextureLoading(const Scene& scene, InstructionSet set) : scene_(scene), set_(set) {
  for (const Request& request : requests(scene)) {
    const auto [index, use] = request;
    if (pictures_.empty() || pictures_.back().index != index) {
      pictures_.push_back({index, {}, encoded_bytes(scene.pictures[static_cast<std::size_t>(index)]), {}});
    }
    pictures_.back().uses.push_back(use);
    library_.chains_[request] = nullptr;
  }
  // Else a thread might end with the largest picture alone.
  std::stable_sort(pictures_.begin(), pictures_.end(),
                   [](const auto& a, const auto& b) { return a.encoded_bytes > b.encoded_bytes; });
}

void TextureLoading::run(std::size_t task) {
  UsedPicture& used = pictures_[task];
  const Picture& picture = scene_.pictures[static_cast<std::size_t>(used.index)];
  Result<Image> decoded;
  const Image* pixels = picture.pixels.get();
  if (pixels == nullptr) {
    decoded = decode(picture);
    if (!decoded) {
      used.faults = std::move(decoded.error().diagnostics);
      return;
    }
    pixels = &*decoded;
  }
  check_values(*pixels, picture, used.faults);
  if (!used.faults.empty()) return;
  for (const image::MipUse use : used.uses) {
    library_.chains_.at({used.index, use}) =
        std::make_unique<image::MipChain>(image::make_mip_chain(*pixels, use, set_));
  }
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
  return std::move(library_);
}

const image::MipChain* TextureLibrary::find(int picture, image::MipUse use) const {
  const auto found = chains_.find({picture, use});
  return found == chains_.end() ? nullptr : found->second.get();
}

}  // namespace laterna::frame
