#include "reference/shadow_truth.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <unordered_map>

#include "reference/picture_probes.h"
#include "reference/shapes.h"
#include "trace/ray_scene.h"

namespace laterna::reference {
namespace {

// Neighbouring truth samples farther apart than this are not on one stretch of a surface.
constexpr double kMostBetweenNeighbours = 8;
// How far a boundary is looked for, in texels.
constexpr double kReach = 32;
constexpr int kCell = 4;  // texels

struct Light_ws {
  bool is_parallel = false;
  glm::dvec3 direction{0};  // toward the light
  glm::dvec3 position{0};
};

Light_ws light_of(const Renderer& renderer, const std::string& name) {
  const Scene& scene = renderer.scene();
  const int node = find_light_node(scene, name);
  if (node < 0) throw std::runtime_error("no light " + name);
  const Pose pose = Pose::from_matrix(world_from_nodes(scene)[static_cast<std::size_t>(node)]).value();
  const Light& light =
      scene.lights[static_cast<std::size_t>(scene.nodes[static_cast<std::size_t>(node)].light)];
  const bool is_parallel = light.type == LightType::directional ||
                           (light.type == LightType::projector && light.projection.is_orthographic);
  return {is_parallel, -pose.forward_ws(), pose.position_ws};
}

// The scene for rays of the tests' own.
class TruthRays {
 public:
  explicit TruthRays(const Scene& scene)
      : owned_(make_frame(with_flat_normals(scene))), rays_(owned_.frame) {}
  [[nodiscard]] bool is_blocked(const glm::dvec3& from, const Light_ws& light, double near) const {
    const glm::dvec3 to_light = light.is_parallel ? light.direction : light.position - from;
    const float length = light.is_parallel ? std::numeric_limits<float>::infinity()
                                           : static_cast<float>(glm::length(to_light));
    return rays_.is_blocked(glm::vec3(from), glm::vec3(glm::normalize(to_light)), static_cast<float>(near),
                            length, kNoTriangle);
  }

 private:
  OwnedFrame owned_;
  trace::RayScene rays_;
};

// Where a point lies in the first map that sees it.
bool locate(const std::vector<ShadowMapFrame>& maps, const glm::dvec3& position_ws, ShadowSample& sample) {
  for (std::size_t face = 0; face < maps.size(); ++face) {
    const auto& [view, width, height] = maps[face];
    const glm::dvec4 q = view.image_from_world() * glm::dvec4(position_ws, 1);
    if (q.w <= 0) continue;
    const glm::dvec2 st = glm::dvec2(q) / q.w;
    if (st.x < 0 || st.y < 0 || st.x > 1 || st.y > 1) continue;
    sample.face = static_cast<int>(face);
    sample.texel = st * glm::dvec2(width, height);
    sample.depth = -(view.view_from_world() * glm::dvec4(position_ws, 1)).z;
    const double span = (view.projection.right - view.projection.left) / width;
    sample.footprint = view.projection.is_orthographic ? span : span * sample.depth;
    return true;
  }
  return false;
}

struct Boundary {
  glm::dvec2 texel;
  double depth;
};

// Boundaries by object, face and cell of the map.
class BoundaryIndex {
 public:
  void add(const ShadowSample& a, const ShadowSample& b) {
    const Boundary boundary = {0.5 * (a.texel + b.texel), 0.5 * (a.depth + b.depth)};
    cells_[key(a.object, a.face, cell(boundary.texel.x), cell(boundary.texel.y))].push_back(boundary);
  }

  // Texels from the sample to the nearest boundary that its surface, going on as it is or twice as steep, would meet;
  // infinity beyond kReach.
  [[nodiscard]] double distance_from(const ShadowSample& sample) const {
    const double depth_per_texel = 2 * (sample.depth_slope + sample.footprint);
    double nearest = std::numeric_limits<double>::infinity();
    const int x = cell(sample.texel.x);
    const int y = cell(sample.texel.y);
    constexpr int kRings = static_cast<int>(kReach) / kCell;
    for (int ring = 0; ring <= kRings && (ring - 1) * kCell < nearest; ++ring) {
      for (int j = -ring; j <= ring; ++j) {
        for (int i = -ring; i <= ring; ++i) {
          if (std::max(std::abs(i), std::abs(j)) != ring) continue;
          const auto found = cells_.find(key(sample.object, sample.face, x + i, y + j));
          if (found == cells_.end()) continue;
          for (const Boundary& b : found->second) {
            const double distance = glm::distance(b.texel, sample.texel);
            if (std::abs(b.depth - sample.depth) <= depth_per_texel * (distance + 1))
              nearest = std::min(nearest, distance);
          }
        }
      }
    }
    return nearest;
  }

 private:
  static int cell(double texel) { return static_cast<int>(std::floor(texel / kCell)); }
  static std::uint64_t key(int object, int face, int x, int y) {
    return ((static_cast<std::uint64_t>(object) * 8 + static_cast<std::uint64_t>(face)) << 32U) |
           (static_cast<std::uint64_t>(x & 0xFFFF) << 16U) | static_cast<std::uint64_t>(y & 0xFFFF);
  }
  std::unordered_map<std::uint64_t, std::vector<Boundary>> cells_;
};

// The truth's samples as a grid.
class TruthGrid {
 public:
  explicit TruthGrid(const ShadowMasks& masks)
      : masks_(masks), width_(masks.width * masks.fineness), height_(masks.height * masks.fineness) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const ShadowSample& sample(int x, int y) const { return masks_.samples[index(x, y)]; }
  [[nodiscard]] bool is_lit(int x, int y) const { return masks_.is_truly_lit[index(x, y)]; }

  // Both counted, of one object, and near each other for the light.
  [[nodiscard]] bool are_neighbours(int x, int y, int x2, int y2, double most_texels) const {
    if (x2 < 0 || y2 < 0 || x2 >= width_ || y2 >= height_) return false;
    const ShadowSample& a = sample(x, y);
    const ShadowSample& b = sample(x2, y2);
    return a.object >= 0 && a.object == b.object && a.face == b.face &&
           glm::distance(a.texel, b.texel) <= most_texels;
  }

  [[nodiscard]] BoundaryIndex boundaries() const {
    BoundaryIndex index;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        for (const auto& [dx, dy] : {std::array{1, 0}, std::array{0, 1}}) {
          if (!are_neighbours(x, y, x + dx, y + dy, kMostBetweenNeighbours)) continue;
          if (is_lit(x, y) != is_lit(x + dx, y + dy)) index.add(sample(x, y), sample(x + dx, y + dy));
        }
      }
    }
    return index;
  }

  static constexpr std::array<std::array<int, 2>, 4> kAround = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  const ShadowMasks& masks_;
  int width_, height_;
};

// The point of a sample's plane that the light sees some texels beside it.
glm::dvec3 beside(const ShadowMapFrame& map, const ShadowSample& sample, glm::dvec2 texels) {
  const glm::dmat4 world_from_image = glm::inverse(map.view.image_from_world());
  const glm::dvec2 st = (sample.texel + texels) / glm::dvec2(map.width, map.height);
  const auto at_depth = [&](double depth) {
    const glm::dvec4 q = world_from_image * glm::dvec4(st, depth, 1);
    return glm::dvec3(q) / q.w;
  };
  const glm::dvec3 start = at_depth(0);
  const glm::dvec3 direction = at_depth(0.5) - start;
  const glm::dvec3 normal(sample.normal_ws);
  return start +
         direction * (glm::dot(normal, glm::dvec3(sample.position_ws) - start) / glm::dot(normal, direction));
}

// Texels from a sample to the nearest point of its plane whose light is `is_lit`, up to kFarTexels; what stands within
// `near` of the points does not count.
double nearest_on_plane(const ShadowMasks& masks, const ShadowSample& sample, bool is_lit, double near) {
  constexpr int kDirections = 16;
  constexpr double kStep = 0.25;
  for (double radius = kStep; radius <= kFarTexels; radius += kStep) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / kDirections;
      const glm::dvec2 texels = radius * glm::dvec2(std::cos(angle), std::sin(angle));
      const glm::dvec3 point = beside(masks.maps[static_cast<std::size_t>(sample.face)], sample, texels);
      if (masks.is_blocked(point, near) != is_lit) return radius;
    }
  }
  return std::numeric_limits<double>::infinity();
}

// Texels from a sample to the nearest point of its plane whose light is not the sample's, up to kFarTexels.
double probed_distance(const ShadowMasks& masks, const ShadowSample& sample, bool is_lit) {
  // A point beside a lit sample may lie under the surface, where that bends, and must not be called dark for it.
  const double near = 2 * sample.footprint + (is_lit ? sample.depth_slope : 0);
  if (masks.is_blocked(glm::dvec3(sample.position_ws), near) == is_lit)
    return std::numeric_limits<double>::infinity();  // what blocks it is near
  return nearest_on_plane(masks, sample, !is_lit, near);
}

// Of a false lit sample: texels from where its shadow begins, if what throws it is near.
double contact_gap(const ShadowMasks& masks, const ShadowSample& sample, double distance) {
  const glm::dvec3 position_ws(sample.position_ws);
  if (masks.is_blocked(position_ws, kContactTexels * sample.footprint)) return 0;
  // Sheets laid on one another are not told apart: the picture's samples lie on one or the other.
  if (!masks.is_blocked(position_ws, kCoincidentTexels * sample.footprint)) return 0;
  constexpr double kSurface = 0.05;  // of a texel: the surface itself
  return std::min(distance, nearest_on_plane(masks, sample, true, kSurface * sample.footprint));
}

}  // namespace

std::vector<ShadowMapFrame> shadow_map_frames(const Renderer& renderer, const std::string& light) {
  std::vector<ShadowMapFrame> frames;
  const std::vector<ShadowMapView> views = renderer.depth_map_views(light).value();
  for (const ShadowMapView& map : views) frames.push_back({map.view, map.width, map.height});
  return frames;
}

Scene with_flat_normals(Scene scene) {
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      primitive.normals.clear();
      primitive.tangents.clear();
    }
  }
  for (Material& material : scene.materials) {
    material.normal_texture = material.metallic_roughness_texture = material.occlusion_texture = {};
    material.emissive_texture = {};
    if (material.alpha_mode == AlphaMode::opaque) material.base_color_texture = {};
  }
  return scene;
}

ShadowMasks draw_shadow_masks(const Renderer& renderer, const View& camera, const RenderSettings& settings,
                              const std::string& light, int fineness) {
  RenderSettings wanted = settings;
  wanted.layers = {Layer::visibility, Layer::object, Layer::position};
  const LayeredImage technique = render(renderer, camera, wanted);
  wanted.width *= fineness;
  wanted.height *= fineness;
  wanted.shadows = ShadowTechnique::raytraced;
  wanted.layers = {Layer::visibility, Layer::object, Layer::position, Layer::normal};
  const LayeredImage truth = render(make_renderer(with_flat_normals(renderer.scene())), camera, wanted);

  ShadowMasks masks;
  masks.width = settings.width;
  masks.height = settings.height;
  masks.fineness = fineness;
  for (const float alpha : values_of(technique, "visibility." + light)) masks.is_lit.push_back(alpha >= 0.5F);
  for (const float alpha : values_of(truth, "visibility." + light))
    masks.is_truly_lit.push_back(alpha >= 0.5F);
  masks.samples.resize(masks.is_truly_lit.size());

  masks.maps = shadow_map_frames(renderer, light);
  const Light_ws light_ws = light_of(renderer, light);
  masks.is_blocked = [rays = std::make_shared<const TruthRays>(renderer.scene()), light_ws](
                         const glm::dvec3& from, double near) {
    return rays->is_blocked(from, light_ws, near);
  };
  const auto vector_at = [](const LayeredImage& image, const std::string& layer, std::size_t i) {
    return glm::dvec3(image.find(layer + "X")->values[i], image.find(layer + "Y")->values[i],
                      image.find(layer + "Z")->values[i]);
  };
  const std::span<const float> objects = values_of(truth, "id.object");
  for (std::size_t i = 0; i < masks.samples.size(); ++i) {
    if (objects[i] < 0) continue;
    const glm::dvec3 position_ws = vector_at(truth, "P.", i);
    const glm::dvec3 to_light = light_ws.is_parallel ? light_ws.direction : light_ws.position - position_ws;
    const double cosine = glm::dot(vector_at(truth, "N.", i), glm::normalize(to_light));
    ShadowSample& sample = masks.samples[i];
    if (cosine <= 0 || !locate(masks.maps, position_ws, sample)) continue;
    sample.object = static_cast<int>(objects[i]);
    sample.position_ws = glm::vec3(position_ws);
    sample.normal_ws = glm::vec3(vector_at(truth, "N.", i));
    sample.depth_slope = sample.footprint * std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  }
  // On a silhouette the two pictures may see different surfaces, also because cut-outs are filtered by the pixel's
  // size: such a pixel compares nothing.
  const std::span<const float> seen = values_of(technique, "id.object");
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(masks.width);
    const std::size_t y = i / static_cast<std::size_t>(masks.width);
    const auto k = static_cast<std::size_t>(fineness);
    const std::size_t centre = (y * k + k / 2) * static_cast<std::size_t>(masks.width) * k + x * k + k / 2;
    ShadowSample& sample = masks.samples[centre];
    const double apart = glm::distance(vector_at(truth, "P.", centre), vector_at(technique, "P.", i));
    if (objects[centre] != seen[i] || apart > 0.1 * sample.footprint) sample.object = -1;
  }
  return masks;
}

ShadowErrors find_shadow_errors(const ShadowMasks& masks) {
  const TruthGrid truth(masks);
  const BoundaryIndex boundaries = truth.boundaries();
  const int k = masks.fineness;
  ShadowErrors errors;
  for (int y = 0; y < masks.height; ++y) {
    for (int x = 0; x < masks.width; ++x) {
      const int tx = x * k + k / 2;
      const int ty = y * k + k / 2;
      const ShadowSample& sample = truth.sample(tx, ty);
      if (sample.object < 0) continue;
      ++errors.pixels;
      const bool is_lit = masks.is_lit[static_cast<std::size_t>(y) * static_cast<std::size_t>(masks.width) +
                                       static_cast<std::size_t>(x)];
      if (is_lit == truth.is_lit(tx, ty)) {
        bool is_edge = false;
        for (const auto& [dx, dy] : TruthGrid::kAround) {
          if (!truth.are_neighbours(tx, ty, tx + dx * k, ty + dy * k, k * kMostBetweenNeighbours)) continue;
          is_edge = is_edge || truth.is_lit(tx + dx * k, ty + dy * k) != is_lit;
        }
        errors.edge_pixels += is_edge ? 1 : 0;
        continue;
      }
      double distance = boundaries.distance_from(sample);
      if (distance >= kEdgeTexels) distance = std::min(distance, probed_distance(masks, sample, !is_lit));
      const bool is_far = distance > kFarTexels;
      ++errors.edge_pixels;
      errors.edge_mismatches += distance < kEdgeTexels ? 0 : 1;
      (is_lit ? errors.false_lit : errors.false_dark) += 1;
      (is_lit ? errors.far_false_lit : errors.far_false_dark) += is_far ? 1 : 0;
      double& farthest = is_lit ? errors.farthest_false_lit : errors.farthest_false_dark;
      farthest = std::max(farthest, distance);
      if (is_lit) errors.contact_gap = std::max(errors.contact_gap, contact_gap(masks, sample, distance));
    }
  }
  return errors;
}

std::string to_string(const ShadowErrors& e) {
  return fmt::format(
      "{} pixels, false dark {} ({} far, at most {:.2f} texels), false lit {} ({} far, at most {:.2f} "
      "texels), "
      "contact gap {:.2f} texels, edge pixels {} ({} mismatched, {:.4f} % right), wrong {:.4f} %",
      e.pixels, e.false_dark, e.far_false_dark, e.farthest_false_dark, e.false_lit, e.far_false_lit,
      e.farthest_false_lit, e.contact_gap, e.edge_pixels, e.edge_mismatches, 100 * e.edge_share(),
      100 * e.wrong_share());
}

}  // namespace laterna::reference
