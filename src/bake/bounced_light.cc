#include "bake/bounced_light.h"

namespace laterna::bake {
namespace {

// A surface is measured at 4 × 4 places of a luxel.
constexpr int kAreaSamples = 4;

// All luxels of all pages in one list, and where each is kept.
class LuxelList {
 public:
  LuxelList(const frame::Frame& frame, const LuxelSurfaces& surfaces, double luxel_side)
      : frame_(frame), surfaces_(surfaces), luxel_side_(luxel_side) {}

  void add(const LitPage& page) {
    const glm::ivec2 tiles = page.triangles->tiles();
    std::vector<Receiver> receivers;
    for (int y = 0; y < tiles.y; ++y) {
      for (int x = 0; x < tiles.x; ++x) {
        find_middles(frame_, *page.triangles, {x, y}, {kAreaSamples, luxel_side_}, receivers);
        add_side(receivers, false, {x, y}, *page.front);
        if (page.back != nullptr) add_side(receivers, true, {x, y}, *page.back);
      }
    }
  }

  [[nodiscard]] std::span<const Luxel> luxels() const { return luxels_; }
  [[nodiscard]] LightSources sources() const { return {direct_, exitance_}; }
  void add_to_pictures(const std::vector<glm::vec3>& irradiance) const {
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
      for (int c = 0; c < 3; ++c) places_[i][static_cast<std::size_t>(c)] += irradiance[i][c];
    }
  }

 private:
  void add_side(std::span<const Receiver> receivers, bool of_back, glm::ivec2 tile, Image& picture) {
    const std::vector<MattSurface> surfaces = surfaces_.find(receivers, of_back);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const Receiver& receiver = receivers[i];
      const auto column = static_cast<std::size_t>(tile.x * kTileSide) + receiver.luxel % kTileSide;
      const auto row = static_cast<std::size_t>(tile.y * kTileSide) + receiver.luxel / kTileSide;
      const std::size_t place = 3 * (row * static_cast<std::size_t>(picture.width()) + column);
      const std::span<float> rgb = picture.values<float>().subspan(place, 3);
      luxels_.push_back({receiver.position_ws, (of_back ? -1.0F : 1.0F) * receiver.normal_ws, receiver.area,
                         receiver.id, surfaces[i].reflectance});
      direct_.emplace_back(rgb[0], rgb[1], rgb[2]);
      exitance_.push_back(surfaces[i].exitance);
      places_.push_back(rgb);
    }
  }

  const frame::Frame& frame_;
  const LuxelSurfaces& surfaces_;
  double luxel_side_;
  std::vector<Luxel> luxels_;
  std::vector<glm::vec3> direct_, exitance_;
  std::vector<std::span<float>> places_;  // red, green and blue in a picture
};

}  // namespace

Result<BouncedLight> add_bounced_light(const frame::Frame& frame, const trace::RayScene& rays,
                                       std::span<const LitPage> pages, const LuxelSurfaces& surfaces,
                                       double luxel_side, const RadiositySettings& settings,
                                       const TaskPool& pool, const Progress& progress,
                                       const PartFiles& parts) {
  LuxelList list(frame, surfaces, luxel_side);
  for (const LitPage& page : pages) list.add(page);
  Result<Interreflection> found =
      interreflect(frame, rays, list.luxels(), list.sources(), settings, pool, progress, parts);
  if (!found) return tl::unexpected(std::move(found.error()));
  list.add_to_pictures(found->irradiance);
  return BouncedLight{found->bounces, list.luxels().size()};
}

}  // namespace laterna::bake
