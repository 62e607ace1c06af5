#include "reference/shadow_ties.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "frame/surface_alpha.h"
#include "raster/raster_view.h"
#include "reference/picture_probes.h"
#include "reference/shadow_truth.h"

namespace laterna::reference {
namespace {

class Casters {
 public:
  explicit Casters(const frame::Frame& frame) : frame_(frame), light_(frame.lights.at(0)) {}

  [[nodiscard]] bool is_blocked(const glm::dvec3& from_ws, double near) const {
    const glm::dvec3 forward = light_.pose.forward_ws();
    const LightType type = light_.light->type;
    const bool is_parallel = type == LightType::directional ||
                             (type == LightType::projector && light_.view.projection.is_orthographic);
    const glm::dvec3 to_light = light_.pose.position_ws - from_ws;
    const glm::dvec3 toward = is_parallel ? -forward : glm::normalize(to_light);
    double far = is_parallel ? std::numeric_limits<double>::infinity() : glm::length(to_light);
    if (type == LightType::projector || (type == LightType::directional && !light_.light->fit)) {
      const double along = -glm::dot(to_light, forward);
      far = (along - light_.view.projection.near) / glm::dot(-toward, forward);
    }
    for (std::uint32_t c = 0; c < frame_.clusters.size(); ++c) {
      const Cluster& cluster = frame_.clusters[c];
      if ((cluster.flags & (kCastsShadow | kAlphaBlend)) != kCastsShadow ||
          !touches(cluster, from_ws, toward))
        continue;
      for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
        if (meets(c << kTriangleBits | t, from_ws, toward, near, far)) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] static bool touches(const Cluster& cluster, const glm::dvec3& from,
                                    const glm::dvec3& toward) {
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const double margin = 1e-6 * (1 + std::abs(from[k]));
      const double a = (cluster.low_ws[k] - margin - from[k]) / toward[k];
      const double b = (cluster.high_ws[k] + margin - from[k]) / toward[k];
      if (toward[k] == 0) continue;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high;
  }

  [[nodiscard]] bool meets(TriangleId id, const glm::dvec3& from, const glm::dvec3& toward, double near,
                           double far) const {
    const Cluster& cluster = frame_.clusters[cluster_of(id)];
    const auto corner = [&](unsigned k) {
      const std::uint32_t v = cluster.first_vertex + (frame_.corners[id] >> (8 * k) & 255U);
      return glm::dvec3(frame_.positions_ws[v]);
    };
    const glm::dvec3 u = corner(1) - corner(0);
    const glm::dvec3 v = corner(2) - corner(0);
    const glm::dvec3 across = glm::cross(toward, v);
    const double determinant = glm::dot(u, across);
    if (determinant == 0) return false;
    const glm::dvec3 offset = from - corner(0);
    const double b = glm::dot(offset, across) / determinant;
    const glm::dvec3 q = glm::cross(offset, u);
    const double c = glm::dot(toward, q) / determinant;
    const double t = glm::dot(v, q) / determinant;
    if (b < 0 || c < 0 || b + c > 1 || t < near || t > far) return false;
    if ((cluster.flags & kAlphaMask) == 0) return true;
    return frame::alpha_at(frame_, id, static_cast<float>(b), static_cast<float>(c)) >=
           frame_.surfaces[cluster.material].alpha_cutoff;
  }

  const frame::Frame& frame_;
  const frame::PlacedLight& light_;
};

glm::dvec3 vector_at(const LayeredImage& image, const std::string& layer, const glm::ivec2& p) {
  return {at(image, layer + "X", p.x, p.y), at(image, layer + "Y", p.x, p.y),
          at(image, layer + "Z", p.x, p.y)};
}

// Whether the light changes somewhere on the sample's plane that is not farther away in the picture.
class TieFinder {
 public:
  TieFinder(const frame::Frame& frame, const raster::RasterView& view, const LayeredImage& image)
      : casters_(frame), view_(view), image_(image) {}

  [[nodiscard]] bool is_tie(const glm::ivec2& pixel) const {
    const double pixel_side = glm::distance(beside(pixel, {1, 0}), beside(pixel, {0, 0})) +
                              glm::distance(beside(pixel, {0, 1}), beside(pixel, {0, 0}));
    // What lies nearer than this is the sample's own triangle and its neighbours. A light that grazes them passes them
    // near the sample and far from it: that too is a tie, up to the same fraction of a pixel.
    const double near = pixel_side * kTiePixels + 1e-6;
    const bool is_dark = casters_.is_blocked(beside(pixel, {0, 0}), near);
    if (casters_.is_blocked(beside(pixel, {0, 0}), std::min(near, kRounding)) != is_dark) return true;
    // Positions are rounded: where the light lies in the sample's plane, that is all that decides.
    for (const double side : {-kPositionError, kPositionError}) {
      const glm::dvec3 lifted = beside(pixel, {0, 0}) + side * vector_at(image_, "N.", pixel);
      if (casters_.is_blocked(lifted, near) != is_dark) return true;
    }
    constexpr int kDirections = 16;
    for (const double radius : {0.25, 0.5, 1.0}) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / kDirections;
        const glm::dvec2 offset = radius * kTiePixels * glm::dvec2(std::cos(angle), std::sin(angle));
        if (casters_.is_blocked(beside(pixel, offset), near) != is_dark) return true;
      }
    }
    return false;
  }

 private:
  // Along the light, of positions in single precision in scenes of some metres, unless the light grazes the surface.
  static constexpr double kRounding = 1e-5;
  static constexpr double kPositionError = 1e-6;

  // The point of the sample's plane that is seen some pixels beside it.
  [[nodiscard]] glm::dvec3 beside(const glm::ivec2& pixel, const glm::dvec2& offset) const {
    const double x = pixel.x + 0.5 - view_.origin_x + offset.x;
    const double y = pixel.y + 0.5 - view_.origin_y + offset.y;
    const raster::RasterView::Ray ray = view_.homogeneous_ray();
    const glm::dvec4 far = ray.ray_0 + ray.ray_x * x + ray.ray_y * y;
    const glm::dvec3 from = view_.is_orthographic ? glm::dvec3(far) : glm::dvec3(ray.q_term);
    const glm::dvec3 direction = view_.is_orthographic ? view_.axis_ws : glm::dvec3(far);
    const glm::dvec3 normal = vector_at(image_, "N.", pixel);
    const glm::dvec3 position = vector_at(image_, "P.", pixel);
    return from + direction * (glm::dot(normal, position - from) / glm::dot(normal, direction));
  }

  Casters casters_;
  const raster::RasterView& view_;
  const LayeredImage& image_;
};

}  // namespace

ShadowMismatches compare_techniques(const Scene& scene, const View& camera, RenderSettings settings,
                                    ShadowTechnique technique, ShadowTechnique truth) {
  const Scene flat = with_flat_normals(scene);
  const Renderer renderer = make_renderer(flat);
  settings.layers = {Layer::visibility, Layer::object, Layer::position, Layer::normal};
  settings.shadows = technique;
  const LayeredImage seen = render(renderer, camera, settings);
  settings.shadows = truth;
  const LayeredImage expected = render(renderer, camera, settings);
  const OwnedFrame owned = make_frame(flat);
  const raster::RasterView view(camera, settings.width, settings.height);
  const TieFinder ties(owned.frame, view, expected);
  const std::string channel = "visibility." + owned.frame.lights.at(0).light->name;
  ShadowMismatches found;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      if (at(expected, "id.object", x, y) < 0) continue;
      const float alpha = at(seen, channel, x, y);
      ++found.seen;
      found.dark += alpha == 0 ? 1 : 0;
      if (alpha == at(expected, channel, x, y)) continue;
      found.pixels.emplace_back(x, y);
      if (!ties.is_tie({x, y})) found.mistakes.emplace_back(x, y);
    }
  }
  return found;
}

std::string to_string(const ShadowMismatches& m) {
  std::string text = std::to_string(m.seen) + " pixels, " + std::to_string(m.dark) + " dark, " +
                     std::to_string(m.pixels.size()) + " different, mistakes:";
  for (const glm::ivec2& p : m.mistakes)
    text += " (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
  return text;
}

}  // namespace laterna::reference
