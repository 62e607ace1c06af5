#include "frame/texture_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

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
  return all;
}

Result<Image> decode(const Picture& picture) {
  if (!picture.encoded.empty()) return decode_image(picture.encoded, picture.name);
  return read_image(picture.file);
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
  // Pictures, each with all its uses: decoded once, then made into as many chains as there are uses.
  std::vector<std::pair<int, std::vector<image::MipUse>>> pictures;
  TextureLibrary library;
  for (const Request& request : requests(scene)) {
    if (pictures.empty() || pictures.back().first != request.first) pictures.push_back({request.first, {}});
    pictures.back().second.push_back(request.second);
    library.chains_[request] = nullptr;
  }
  std::vector<std::vector<Diagnostic>> faults(pictures.size());
  pool.for_each(pictures.size(), [&](std::size_t i, int) {
    const auto& [index, uses] = pictures[i];
    const Picture& picture = scene.pictures[static_cast<std::size_t>(index)];
    Result<Image> decoded;
    const Image* pixels = picture.pixels.get();
    if (pixels == nullptr) {
      decoded = decode(picture);
      if (!decoded) {
        faults[i] = std::move(decoded.error().diagnostics);
        return;
      }
      pixels = &*decoded;
    }
    check_values(*pixels, picture, faults[i]);
    if (!faults[i].empty()) return;
    for (const image::MipUse use : uses) {
      library.chains_.at({index, use}) =
          std::make_unique<image::MipChain>(image::make_mip_chain(*pixels, use, set));
    }
  });
  Error error;
  for (auto& list : faults) {
    for (Diagnostic& fault : list) error.diagnostics.push_back(std::move(fault));
  }
  if (!error.diagnostics.empty()) return tl::unexpected(std::move(error));
  return library;
}

const image::MipChain* TextureLibrary::find(int picture, image::MipUse use) const {
  const auto found = chains_.find({picture, use});
  return found == chains_.end() ? nullptr : found->second.get();
}

}  // namespace laterna::frame
