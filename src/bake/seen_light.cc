#include "bake/seen_light.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "image/colour.h"
#include "laterna/render.h"

namespace laterna::bake {
namespace {

constexpr float kInversePi = 0.31830989F;

// What is seen of a surface on which `irradiance` falls. As beside light maps, a material's own occlusion texture stays, and what
// was baked is for those that have none.
glm::vec3 seen(const MattSurface& surface, const Showing& showing, float openness,
               const glm::vec3& irradiance) {
  glm::vec3 from_all_sides = showing.ambient;
  if (showing.environment != nullptr)
    from_all_sides += showing.environment->on(surface.normal_ws) * kInversePi;
  return surface.reflectance *
             (irradiance * kInversePi + from_all_sides * surface.openness.value_or(openness)) +
         surface.exitance * kInversePi;
}

// The mean over the receivers of each luxel, which come one after the other.
void show_tile(std::span<const Receiver> receivers, std::span<const MattSurface> surfaces, glm::ivec2 tile,
               const Showing& showing, const Image* occlusion, Image& picture) {
  for (std::size_t first = 0, end = 0; first < receivers.size(); first = end) {
    const std::uint32_t luxel = receivers[first].luxel;
    const int column = tile.x * kTileSide + static_cast<int>(luxel % kTileSide);
    const int row = tile.y * kTileSide + static_cast<int>(luxel / kTileSide);
    const std::size_t place = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width()) +
                                   static_cast<std::size_t>(column));
    const std::span<float> rgb = picture.values<float>().subspan(place, 3);
    const float openness = occlusion == nullptr ? 1 : occlusion->value(column, row, 0);
    const glm::vec3 irradiance(rgb[0], rgb[1], rgb[2]);
    glm::vec3 sum(0);
    for (; end < receivers.size() && receivers[end].luxel == luxel; ++end)
      sum += seen(surfaces[end], showing, openness, irradiance);
    for (int c = 0; c < 3; ++c) rgb[static_cast<std::size_t>(c)] = sum[c] / static_cast<float>(end - first);
  }
}

void show_page(const SeenScene& scene, const PageTriangles& triangles, const Showing& showing,
               BakedPage& page) {
  const glm::ivec2 tiles = triangles.tiles();
  const auto show = [&](std::size_t index, int) {
    const glm::ivec2 tile(static_cast<int>(index) % tiles.x, static_cast<int>(index) / tiles.x);
    std::vector<Receiver> receivers;
    find_receivers(scene.frame, scene.rays, triangles, tile, showing.receivers, receivers);
    if (receivers.empty()) return;
    for (const bool of_back : {false, true}) {
      Image* const picture = (of_back ? page.back : page.front).get();
      if (picture == nullptr) continue;
      show_tile(receivers, scene.surfaces.find(receivers, of_back), tile, showing, page.occlusion.get(),
                *picture);
    }
  };
  scene.pool.for_each(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), show);
}

float exposure_for(std::span<const BakedPage> pages) {
  LayeredImage all;
  all.channels = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (const BakedPage& page : pages) {
    for (const Image* picture : {page.front.get(), page.back.get()}) {
      if (picture == nullptr) continue;
      const std::span<const float> rgb = picture->values<float>();
      for (std::size_t i = 0; i < page.is_found.size(); ++i) {
        if (page.is_found[i] == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) all.channels[c].values.push_back(rgb[3 * i + c]);
      }
    }
  }
  all.width = static_cast<int>(all.channels[0].values.size());
  all.height = 1;
  return automatic_exposure(all);
}

std::shared_ptr<Image> encoded(const Image& linear, float exposure) {
  auto image = std::make_shared<Image>(linear.width(), linear.height(), 3, PixelType::u8, Transfer::srgb);
  std::vector<float> exposed(linear.values<float>().begin(), linear.values<float>().end());
  for (float& value : exposed) value *= exposure;
  image::encode_srgb(exposed, image->values<std::uint8_t>());
  return image;
}

}  // namespace

void show_surfaces(const SeenScene& scene, std::span<const std::unique_ptr<PageTriangles>> triangles,
                   const Showing& showing, std::span<BakedPage> pages) {
  for (std::size_t page = 0; page < pages.size(); ++page)
    show_page(scene, *triangles[page], showing, pages[page]);
}

float encode_pages(std::span<BakedPage> pages, float exposure) {
  if (!(exposure > 0)) exposure = exposure_for(pages);
  for (BakedPage& page : pages) {
    page.front = encoded(*page.front, exposure);
    if (page.back != nullptr) page.back = encoded(*page.back, exposure);
    page.occlusion = nullptr;
  }
  return exposure;
}

}  // namespace laterna::bake
