#include "laterna/quake_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

#include "bake/luxel_surfaces.h"
#include "bake/own_frame.h"
#include "bake/surface_cache.h"
#include "base/flat_triangle.h"
#include "base/refuse.h"
#include "image/colour.h"
#include "image/luminance.h"
#include "image/mip_chain.h"
#include "render/settings_check.h"
#include "trace/ray_scene.h"

namespace laterna {
namespace bake {
namespace {

constexpr std::uint32_t kNoSurface = 0xFFFFFFFFU;

// A light map as one byte for each luxel.
struct IntensityMap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> values;

  IntensityMap(const image::MipChain& chain, float scale) : width(chain.width()), height(chain.height()) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto t = image::texel(chain, 0, x, y);
        const float v = std::clamp(image::luminance(t[0], t[1], t[2]) * scale, 0.0F, 1.0F);
        values.push_back(static_cast<std::uint8_t>(v * 255.0F + 0.5F));
      }
    }
  }

  // Bilinear, 0 … 1; `at` in luxels.
  [[nodiscard]] float look_up(glm::dvec2 at) const {
    at -= 0.5;
    const glm::dvec2 low = glm::floor(at), weight = at - low;
    const auto value = [&](double x, double y) {
      const int column = std::clamp(static_cast<int>(x), 0, width - 1);
      const int row = std::clamp(static_cast<int>(y), 0, height - 1);
      return double{static_cast<double>(values[static_cast<std::size_t>(row * width + column)])};
    };
    const double above = glm::mix(value(low.x, low.y), value(low.x + 1, low.y), weight.x);
    const double below = glm::mix(value(low.x, low.y + 1), value(low.x + 1, low.y + 1), weight.x);
    return static_cast<float>(glm::mix(above, below, weight.y) / 255);
  }
};

// A chart of a light map.
struct QuakeSurface {
  std::vector<TriangleId> triangles;
  const IntensityMap* light = nullptr;
  glm::dvec2 low{std::numeric_limits<double>::infinity()};  // in luxels of the page
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  double luxel_side = 0;  // metres
};

std::array<glm::dvec2, 3> luxels_of(const frame::Frame& frame, TriangleId id, const IntensityMap& light) {
  const std::uint32_t first = frame.streams[cluster_of(id)].uv[1];
  std::array<glm::dvec2, 3> corners{};
  for (unsigned k = 0; k < 3; ++k) {
    const std::size_t v = first + (frame.corners[id] >> (8 * k) & 255U);
    corners[k] = glm::dvec2(frame.uvs[1][v]) * glm::dvec2(light.width, light.height);
  }
  return corners;
}

double area_of(const frame::Frame& frame, TriangleId id) {
  const glm::dvec3 a(frame.corner_ws(id, 0));
  const glm::dvec3 n =
      glm::cross(glm::dvec3(frame.corner_ws(id, 1)) - a, glm::dvec3(frame.corner_ws(id, 2)) - a);
  return std::sqrt(glm::dot(n, n)) / 2;
}

// Quake cut its surfaces at 16 luxels; here, those that would be very large are shown at a lesser size.
bool fits(const QuakeSurface& surface, int size) {
  constexpr double kMostTexels = 1 << 24;
  const glm::dvec2 extent = (surface.high - surface.low) * static_cast<double>(kQuakeTexelsPerLuxel >> size);
  return extent.x * extent.y <= kMostTexels;
}

// Sets of things that belong together, found pair by pair.
class Unions {
 public:
  explicit Unions(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

// What a pixel shows.
struct QuakePixel {
  std::uint32_t surface = kNoSurface;
  TriangleId id = kNoTriangle;
  float b = 0, c = 0;
  double width = 0;  // metres across, on a surface that faces the eye
};

}  // namespace bake

struct QuakeWalk::Implementation {
  Implementation(Scene baked, const QuakeSettings& chosen)
      : scene(std::move(baked)),
        settings(chosen),
        pool(chosen.options.threads),
        cache(chosen.cache_bytes, statistics) {}

  Result<void> load();
  void find_intensity_maps();
  void find_surfaces();
  [[nodiscard]] bake::QuakePixel look(const glm::dmat4& world_from_image, glm::dvec2 pixel) const;
  [[nodiscard]] bake::CombinedSurface combine(const bake::QuakeSurface& surface, int size,
                                              QuakePicture picture) const;
  [[nodiscard]] std::vector<std::uint8_t> paint(const bake::QuakeSurface& surface, double texels,
                                                QuakePicture picture,
                                                std::span<const bake::Receiver> receivers,
                                                std::span<const glm::dvec2> places) const;

  Scene scene;
  QuakeSettings settings;
  TaskPool pool;
  std::unique_ptr<bake::OwnFrame> own;
  std::shared_ptr<const trace::RayScene> rays;
  InstructionSet set = InstructionSet::scalar;
  std::map<const image::MipChain*, bake::IntensityMap> maps;
  std::vector<bake::QuakeSurface> surfaces;
  std::vector<std::uint32_t> surface_of;  // by triangle
  QuakeStatistics statistics;
  bake::SurfaceCache cache;
};

Result<void> QuakeWalk::Implementation::load() {
  set = settings.options.instruction_set.value_or(best_instruction_set());
  Result<std::unique_ptr<bake::OwnFrame>> made = bake::make_frame(scene, settings.options.time, set, pool);
  if (!made) return tl::unexpected(std::move(made.error()));
  own = std::move(*made);
  rays = std::make_shared<const trace::RayScene>(own->frame);
  find_intensity_maps();
  if (maps.empty()) return refuse("the scene has no light maps: bake it first");
  find_surfaces();
  return {};
}

void QuakeWalk::Implementation::find_intensity_maps() {
  std::vector<const image::MipChain*> chains;
  for (const frame::Surface& surface : own->frame.surfaces) {
    if (surface.light_map.front.chain != nullptr && surface.light_map.front.uv_set == 1)
      chains.push_back(surface.light_map.front.chain);
  }
  auto white = static_cast<float>(settings.white_lux);
  for (std::size_t i = 0; settings.white_lux == 0 && i < chains.size(); ++i) {
    for (int y = 0; y < chains[i]->height(); ++y) {
      for (int x = 0; x < chains[i]->width(); ++x) {
        const auto t = image::texel(*chains[i], 0, x, y);
        white = std::max(white, image::luminance(t[0], t[1], t[2]));
      }
    }
  }
  for (const image::MipChain* chain : chains) maps.try_emplace(chain, *chain, white > 0 ? 1 / white : 0);
}

void QuakeWalk::Implementation::find_surfaces() {
  const frame::Frame& frame = own->frame;
  std::vector<TriangleId> triangles;
  std::vector<const bake::IntensityMap*> lights;
  for (std::uint32_t cluster = 0; cluster < frame.clusters.size(); ++cluster) {
    const auto& map = frame.surfaces[frame.clusters[cluster].material].light_map.front;
    const auto light = maps.find(map.chain);
    if (light == maps.end() || frame.streams[cluster].uv[1] == frame::kNoStream) continue;
    for (std::uint32_t t = 0; t < frame.clusters[cluster].triangle_count; ++t) {
      triangles.push_back(cluster << kTriangleBits | t);
      lights.push_back(&light->second);
    }
  }
  // Triangles of a chart meet at places of the light map; those of two charts never do.
  bake::Unions unions(triangles.size());
  std::map<std::tuple<const bake::IntensityMap*, double, double>, std::uint32_t> first_at;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (const glm::dvec2& p : bake::luxels_of(frame, triangles[i], *lights[i]))
      unions.join(i, first_at.try_emplace({lights[i], p.x, p.y}, i).first->second);
  }
  surface_of.assign(frame.clusters.size() << kTriangleBits, bake::kNoSurface);
  std::map<std::uint32_t, std::uint32_t> surface_of_root;
  std::vector<double> flat_area, area;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto [entry, is_new] =
        surface_of_root.try_emplace(unions.find(i), static_cast<std::uint32_t>(surfaces.size()));
    if (is_new) {
      surfaces.emplace_back();
      flat_area.push_back(0);
      area.push_back(0);
    }
    bake::QuakeSurface& surface = surfaces[entry->second];
    surface.triangles.push_back(triangles[i]);
    surface.light = lights[i];
    const FlatTriangle flat(bake::luxels_of(frame, triangles[i], *lights[i]));
    surface.low = glm::min(surface.low, flat.low());
    surface.high = glm::max(surface.high, flat.high());
    flat_area[entry->second] += std::abs(flat.twice_area()) / 2;
    area[entry->second] += bake::area_of(frame, triangles[i]);
    surface_of[triangles[i]] = entry->second;
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    surfaces[s].luxel_side = flat_area[s] > 0 ? std::sqrt(area[s] / flat_area[s]) : 0;
}

bake::QuakePixel QuakeWalk::Implementation::look(const glm::dmat4& world_from_image, glm::dvec2 pixel) const {
  const auto point = [&](double x, double depth) {
    const glm::dvec4 p =
        world_from_image * glm::dvec4(x / settings.width, pixel.y / settings.height, depth, 1);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 near = point(pixel.x, 0), along = point(pixel.x, 0.5) - near;
  bake::QuakePixel found;
  const auto hit = rays->find_nearest(glm::vec3(near), glm::vec3(along), 0,
                                      std::numeric_limits<float>::infinity(), kNoTriangle);
  if (!hit) return found;
  found.id = hit->id;
  found.b = hit->b;
  found.c = hit->c;
  found.surface = surface_of[hit->id];
  const glm::dvec3 next_near = point(pixel.x + 1, 0), next = point(pixel.x + 1, 0.5) - next_near;
  found.width = glm::length(next_near + next * double{hit->distance} - near - along * double{hit->distance});
  return found;
}

bake::CombinedSurface QuakeWalk::Implementation::combine(const bake::QuakeSurface& surface, int size,
                                                         QuakePicture picture) const {
  const double texels = kQuakeTexelsPerLuxel >> size;
  const glm::dvec2 extent = (surface.high - surface.low) * texels;
  bake::CombinedSurface made;
  made.width = std::max(1, static_cast<int>(std::ceil(extent.x)));
  made.height = std::max(1, static_cast<int>(std::ceil(extent.y)));
  const auto count = static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height);
  std::vector<double> nearest(count, std::numeric_limits<double>::infinity());
  std::vector<bake::Receiver> texel_receivers(count);
  std::vector<glm::dvec2> places(count);  // in the light map
  for (const TriangleId id : surface.triangles) {
    const FlatTriangle flat(bake::luxels_of(own->frame, id, *surface.light));
    const glm::dvec2 most(made.width - 1, made.height - 1);
    // Texels at the rim, whose middles lie beside the surface, take what is nearest.
    const glm::ivec2 first(
        glm::clamp(glm::floor((flat.low() - surface.low) * texels) - 1.0, glm::dvec2(0), most));
    const glm::ivec2 last(
        glm::clamp(glm::floor((flat.high() - surface.low) * texels) + 1.0, glm::dvec2(0), most));
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        const glm::dvec2 at = surface.low + glm::dvec2(x + 0.5, y + 0.5) / texels;
        double squared = 0;
        const FlatWeights weights = flat.nearest(at, squared);
        const auto texel = static_cast<std::size_t>(y * made.width + x);
        if (!(squared < nearest[texel])) continue;
        nearest[texel] = squared;
        texel_receivers[texel] = bake::receiver_on(own->frame, id, weights);
        places[texel] = at;
      }
    }
  }
  made.rgb = paint(surface, texels, picture, texel_receivers, places);
  return made;
}

// Texels that no triangle is near are black.
std::vector<std::uint8_t> QuakeWalk::Implementation::paint(const bake::QuakeSurface& surface, double texels,
                                                           QuakePicture picture,
                                                           std::span<const bake::Receiver> receivers,
                                                           std::span<const glm::dvec2> places) const {
  std::vector<bake::MattSurface> colors;
  if (picture != QuakePicture::light_map)
    colors = bake::LuxelSurfaces(own->frame, rays, surface.luxel_side / texels, set).find(receivers, false);
  std::vector<float> linear(3 * receivers.size(), 0.0F);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (receivers[i].id == kNoTriangle) continue;
    glm::vec3 color = colors.empty() ? glm::vec3(1) : colors[i].reflectance;
    if (picture != QuakePicture::texture) color *= surface.light->look_up(places[i]);
    for (std::size_t c = 0; c < 3; ++c) linear[3 * i + c] = color[static_cast<int>(c)];
  }
  std::vector<std::uint8_t> rgb(linear.size());
  image::encode_srgb(linear, rgb);
  return rgb;
}

QuakeWalk::QuakeWalk(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
QuakeWalk::~QuakeWalk() = default;
QuakeWalk::QuakeWalk(QuakeWalk&&) noexcept = default;
QuakeWalk& QuakeWalk::operator=(QuakeWalk&&) noexcept = default;

Result<QuakeWalk> QuakeWalk::create(Scene baked, const QuakeSettings& settings) {
  constexpr int kMostPixels = 16384;
  if (std::min(settings.width, settings.height) < 1 ||
      std::max(settings.width, settings.height) > kMostPixels)
    return refuse(fmt::format("expected a picture of 1 to {} pixels in either direction, got {} x {}",
                              kMostPixels, settings.width, settings.height));
  if (!(settings.white_lux >= 0) || !std::isfinite(settings.white_lux))
    return refuse(fmt::format("white_lux: expected a number of at least 0, got {}", settings.white_lux));
  if (Result<void> checked = render::check_options(settings.options); !checked)
    return tl::unexpected(std::move(checked.error()));
  if (std::vector<Diagnostic> faults = validate(baked); !faults.empty())
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  auto implementation = std::make_unique<Implementation>(std::move(baked), settings);
  if (Result<void> loaded = implementation->load(); !loaded) return tl::unexpected(std::move(loaded.error()));
  return QuakeWalk(std::move(implementation));
}

Image QuakeWalk::draw(const View& view, QuakePicture picture) {
  Implementation& walk = *implementation_;
  const int width = walk.settings.width, height = walk.settings.height;
  const glm::dmat4 world_from_image = glm::inverse(view.image_from_world());
  std::vector<bake::QuakePixel> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  walk.pool.for_each(static_cast<std::size_t>(height), [&](std::size_t y, int) {
    for (int x = 0; x < width; ++x)
      pixels[y * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
          walk.look(world_from_image, {x + 0.5, static_cast<double>(y) + 0.5});
  });
  // Surface by surface: each is asked for once.
  std::map<std::uint32_t, std::vector<std::uint32_t>> seen;
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i].surface != bake::kNoSurface) seen[pixels[i].surface].push_back(i);
  }
  Image image(width, height, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> rgb = image.values<std::uint8_t>();
  for (const auto& [number, places] : seen) {
    const bake::QuakeSurface& surface = walk.surfaces[number];
    double finest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : places) finest = std::min(finest, pixels[i].width);
    // The largest size whose texels are no smaller than the nearest pixel.
    int size = 0;
    while (size + 1 < kQuakeSizes && !fits(surface, size)) ++size;
    while (size + 1 < kQuakeSizes && surface.luxel_side / (kQuakeTexelsPerLuxel >> size) < finest) ++size;
    const auto combine = [&] { return walk.combine(surface, size, picture); };
    const std::shared_ptr<const bake::CombinedSurface> combined =
        picture == QuakePicture::product ? walk.cache.find({number, size}, combine)
                                         : std::make_shared<const bake::CombinedSurface>(combine());
    for (const std::uint32_t i : places) {
      const bake::QuakePixel& pixel = pixels[i];
      const auto corners = bake::luxels_of(walk.own->frame, pixel.id, *surface.light);
      const glm::dvec2 at = corners[0] + double{pixel.b} * (corners[1] - corners[0]) +
                            double{pixel.c} * (corners[2] - corners[0]);
      const glm::dvec2 texel = (at - surface.low) * static_cast<double>(kQuakeTexelsPerLuxel >> size);
      const int x = std::clamp(static_cast<int>(texel.x), 0, combined->width - 1);
      const int y = std::clamp(static_cast<int>(texel.y), 0, combined->height - 1);
      const auto from = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(combined->width) +
                             static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = combined->rgb[from + c];
    }
  }
  if (picture == QuakePicture::product) ++walk.statistics.pictures;
  return image;
}

const QuakeStatistics& QuakeWalk::statistics() const { return implementation_->statistics; }

}  // namespace laterna
