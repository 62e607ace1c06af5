#include "bake/seen_light.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "bake/luxel_surface.h"
#include "image/colour.h"
#include "laterna/render.h"

namespace laterna::bake {
namespace {

constexpr float kInversePi = 0.31830989F;

void show_page(const frame::Frame& frame, const PageTriangles& triangles, const Showing& showing,
               BakedPage& page) {
  std::vector<Receiver> receivers;
  for (int y = 0; y < triangles.tiles().y; ++y) {
    for (int x = 0; x < triangles.tiles().x; ++x) {
      find_middles(frame, triangles, {x, y}, {1, showing.luxel_side}, receivers);
      for (const Receiver& receiver : receivers) {
        const int column = x * kTileSide + static_cast<int>(receiver.luxel % kTileSide);
        const int row = y * kTileSide + static_cast<int>(receiver.luxel / kTileSide);
        const MattSurface surface = surface_at(frame, receiver, showing.luxel_side);
        const float openness = page.occlusion == nullptr ? 1 : page.occlusion->value(column, row, 0);
        const std::size_t place =
            3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(triangles.size().x) +
                 static_cast<std::size_t>(column));
        for (Image* picture : {page.front.get(), page.back.get()}) {
          if (picture == nullptr) continue;
          const std::span<float> rgb = picture->values<float>().subspan(place, 3);
          for (int c = 0; c < 3; ++c) {
            float& value = rgb[static_cast<std::size_t>(c)];
            value = surface.reflectance[c] * (value * kInversePi + showing.ambient[c] * openness) +
                    surface.exitance[c] * kInversePi;
          }
        }
      }
    }
  }
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

float make_visible(const frame::Frame& frame, std::span<const std::unique_ptr<PageTriangles>> triangles,
                   const Showing& showing, std::span<BakedPage> pages) {
  for (std::size_t page = 0; page < pages.size(); ++page)
    show_page(frame, *triangles[page], showing, pages[page]);
  const float exposure = showing.exposure > 0 ? showing.exposure : exposure_for(pages);
  for (BakedPage& page : pages) {
    page.front = encoded(*page.front, exposure);
    if (page.back != nullptr) page.back = encoded(*page.back, exposure);
    page.occlusion = nullptr;
  }
  return exposure;
}

}  // namespace laterna::bake
