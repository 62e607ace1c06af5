#include "shade/mirror_blur.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace laterna::shade {
namespace {

constexpr float kRaysAcross = 7;  // of a disc; a level's pixels are as large as what lies between them

// Pixels: what is mirrored at a radius of less touches the mirror.
constexpr float kContact = 1;

// Of the pixels about one that looks past what it touches, that which lies deepest in it. Null: none touches. On the last pixel of
// the mirror before a wall some samples see the wall's foot and some, which are not the mirror's, what lies behind it.
template <class Radius>
const glm::vec4* touching_beside(const MirrorPicture& picture, float x, float y, const Radius& radius_of) {
  const glm::vec4* touching = nullptr;
  float least = kContact;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::vec4& tap = picture.nearest(x + static_cast<float>(dx), y + static_cast<float>(dy));
      const float radius = radius_of(tap);
      if (radius >= least) continue;
      least = radius;
      touching = &tap;
    }
  }
  return touching;
}

}  // namespace

// Behind the mirror by t they meet the picture on a circle whose radius grows with t, and each is followed outward to the first
// place whose depth belongs to that radius or a smaller one. So contacts stay sharp, and what lies nearer to the mirror than what
// it stands before is the sharper.
glm::vec3 blurred(const MirrorPicture& picture, const raster::RasterView& view, float spread, float distance,
                  float x, float y) {
  constexpr int kSteps = 7, kHalvings = 6;
  constexpr float kLeap = 2;  // of radii, in pixels: nothing that one would see
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
  // Between a radius at which the ray is in the open and one at which it is not, the one at which it meets what lies there;
  // less than nothing where depths leap: what lies behind that, the picture does not see.
  const auto meeting = [&](const glm::vec2& ray, float open, float behind) {
    float own_open = radius_of(look(ray, open)), own_behind = radius_of(look(ray, behind));
    for (int halving = 0; halving < kHalvings && behind - open > 0.1F; ++halving) {
      const float middle = (open + behind) / 2, own = radius_of(look(ray, middle));
      (own > middle ? open : behind) = middle;
      (own > middle ? own_open : own_behind) = own;
    }
    return own_open - own_behind <= kLeap + 0.1F * behind ? std::clamp(own_behind, open, behind) : -1.0F;
  };
  // At a contact the rays of one side meet something sooner than the first step is long, and leave the picture beyond it.
  const float at_once = radius_of(picture.nearest(x, y));
  if (at_once > kContact) {
    if (const glm::vec4* touching = touching_beside(picture, x, y, radius_of)) return glm::vec3(*touching);
  }
  const int first_step = at_once < widest / (kSteps * kSteps) ? 0 : 1;
  glm::vec3 sum(0);
  for (const glm::vec2& ray : picture.cone_rays()) {
    glm::vec4 seen = look(ray, 0);  // where the ray was last in the open
    float open = 0;
    for (int step = first_step; step <= kSteps; ++step) {
      const float share = static_cast<float>(step) / kSteps,
                  radius = step == 0 ? at_once : widest * share * share;
      const glm::vec4 tap = look(ray, radius);
      // What the ray was before may end between two steps, and be met before that.
      const float before = radius_of(seen);
      const bool meets_before =
          before <= radius && std::abs(radius_of(look(ray, before)) - before) <= 0.1F * before + 0.01F;
      if (!meets_before && radius_of(tap) > radius) {
        seen = tap;
        open = radius;
        continue;
      }
      const float met = meets_before ? before : meeting(ray, open, radius);
      if (met < 0) continue;
      // Its colour from about what lies between the rays.
      const int level = picture.level_of(met / kRaysAcross);
      seen = level == 0 ? look(ray, met) : picture.interpolated(x + ray.x * met, y + ray.y * met, level);
      break;
    }
    sum += glm::vec3(seen);
  }
  return sum / static_cast<float>(kConeRays);
}

}  // namespace laterna::shade
