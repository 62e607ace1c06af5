#include "shade/mirror_blur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>

#include "base/elementary.h"

namespace laterna::shade {
namespace {

// Rays of a cone, as places of the unit disc that they fill evenly: Vogel 1979, A better way to construct the sunflower head.
constexpr int kRays = 48;
constexpr float kRaysAcross = 7;  // a level's pixels are as large as what lies between them

const std::array<glm::vec2, kRays>& rays_of_cone() {
  static const std::array<glm::vec2, kRays> rays = [] {
    constexpr double kGoldenAngle = 2.39996322972865332;
    std::array<glm::vec2, kRays> made;
    for (int i = 0; i < kRays; ++i) {
      const double radius = std::sqrt((i + 0.5) / kRays), angle = kGoldenAngle * i;
      made[static_cast<std::size_t>(i)] = glm::vec2(radius * cosine(angle), radius * sine(angle));
    }
    return made;
  }();
  return rays;
}

}  // namespace

// Behind the mirror by t they meet the picture on a circle whose radius grows with t, and each is followed outward to the first
// place whose depth belongs to that radius or a smaller one. So contacts stay sharp, and what lies nearer to the mirror than what
// it stands before is the sharper.
glm::vec3 blurred(const MirrorPicture& picture, const raster::RasterView& view, float spread, float distance,
                  float x, float y) {
  constexpr int kSteps = 7;
  const Projection& p = view.view.projection;
  const auto pixels_per_tangent = static_cast<float>(view.width / (p.right - p.left));
  // In an orthographic view circles grow without end; where nothing is, they are as large as at the farthest that there is.
  const float farthest = picture.farthest();
  const auto radius_of = [&](const glm::vec4& tap) {
    if (view.is_orthographic) {
      const float behind = tap.w > 0 ? 1 / tap.w : farthest;
      return spread * pixels_per_tangent * std::max(behind - distance, 0.0F);
    }
    return spread * pixels_per_tangent * std::clamp(1 - tap.w * distance, 0.0F, 1.0F);
  };
  const float widest =
      spread * pixels_per_tangent * (view.is_orthographic ? std::max(farthest - distance, 0.0F) : 1.0F);
  // Between pixels of different depth there is nothing: the nearest pixel is what is there.
  const auto look = [&](const glm::vec2& ray, float radius) {
    return picture.nearest(x + ray.x * radius, y + ray.y * radius);
  };
  // Where the ray is as deep as what was seen, is that still there?
  const auto meets = [&](const glm::vec2& ray, float own) {
    return std::abs(radius_of(look(ray, own)) - own) <= 0.1F * own + 0.01F;
  };
  glm::vec3 sum(0);
  for (const glm::vec2& ray : rays_of_cone()) {
    glm::vec4 seen = look(ray, 0);  // where the ray was last in the open
    for (int step = 1; step <= kSteps; ++step) {
      const float share = static_cast<float>(step) / kSteps, radius = widest * share * share;
      const glm::vec4 tap = look(ray, radius);
      const float before = radius_of(seen), own = radius_of(tap);
      const bool meets_before = before <= radius && meets(ray, before);
      if (!meets_before && own > radius) {
        seen = tap;
        continue;
      }
      // Behind what lies here, without having met it: where the picture does not look.
      if (!meets_before && !meets(ray, own)) continue;
      const float met = meets_before ? before : own;
      // Its colour from about what lies between the rays.
      const int level = picture.level_of(met / kRaysAcross);
      seen = level == 0 ? look(ray, met) : picture.interpolated(x + ray.x * met, y + ray.y * met, level);
      break;
    }
    sum += glm::vec3(seen);
  }
  return sum / static_cast<float>(kRays);
}

}  // namespace laterna::shade
