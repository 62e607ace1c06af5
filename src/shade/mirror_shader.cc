#include "shade/mirror_shader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "base/elementary.h"
#include "shade/fresnel.h"

namespace laterna::shade {

// A look at a place of a mirror.
struct MirrorShader::Sight {
  glm::dvec3 along_ws;  // unit, from the eye
  glm::dvec3 place_ws;  // on the mirror
  double footprint;     // of a pixel, metres along the mirror
};

namespace {

constexpr double kGravity = 9.80665;  // m/s²

glm::vec3 share_of(const Mirror& mirror, double cosine) {
  if (mirror.ior) return mirror.reflectance * static_cast<float>(fresnel_reflectance(cosine, *mirror.ior));
  return mirror.reflectance +
         (glm::vec3(1) - mirror.reflectance) * static_cast<float>(schlick_weight(cosine));
}

// The slope of a train of waves at a place, along its direction within the surface. Waves shorter than a few pixels flatten:
// no picture shows them.
double slope_of(const Wave& wave, double along, double seconds, double footprint) {
  const double shown = std::clamp(wave.length / (4 * footprint) - 0.5, 0.0, 1.0);
  const double speed = wave.speed.value_or(std::sqrt(kGravity * wave.length / (2 * kPi)));
  const double cycles = (along - speed * seconds) / wave.length;
  return shown * wave.amplitude * (2 * kPi / wave.length) *
         cosine(2 * kPi * (cycles - std::floor(cycles)) + wave.phase);
}

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

// The normal of h = Σ waves over the plane: n − ∇h.
glm::dvec3 MirrorShader::normal_on_waves(const MirrorPicture& picture, const Sight& sight) const {
  const glm::dvec3& n = picture.normal_ws();
  glm::dvec3 normal = n;
  for (const Wave& wave : picture.mirror().waves) {
    const glm::dvec3 within = wave.direction_ws - glm::dot(wave.direction_ws, n) * n;
    const double length = glm::length(within);
    if (length <= 1e-9 * glm::length(wave.direction_ws)) continue;  // straight through the surface
    const glm::dvec3 direction = within / length;
    normal -=
        direction * slope_of(wave, glm::dot(direction, sight.place_ws), picture.seconds(), sight.footprint);
  }
  return normal / glm::length(normal);
}

// Where in the picture the ray from a place of the mirror ends that its waves send elsewhere: the ray is mirrored in the plane,
// into the space that the picture shows, and followed to the depth that the picture has there. That depth is taken at the sample
// first, and once more where it leads.
glm::vec2 MirrorShader::displaced(const MirrorPicture& picture, const MirrorSample& sample,
                                  const Sight& sight, const glm::dvec3& normal_ws) const {
  const glm::dvec3& n = picture.normal_ws();
  const glm::dvec3 reflected = sight.along_ws - 2 * glm::dot(sight.along_ws, normal_ws) * normal_ws;
  // Not into the water: a ray that would meets another wave, and goes on.
  const glm::dvec3 behind = reflected - (glm::dot(reflected, n) + std::abs(glm::dot(reflected, n))) * n;
  const double forward = glm::dot(behind, view_.view.pose.forward_ws());
  glm::dvec2 place(sample.x, sample.y);
  if (forward <= 1e-3) return place + glm::dvec2(view_.origin_x, view_.origin_y);
  const double from = view_.distance_from_reversed(sample.q);
  for (int step = 0; step < 2; ++step) {
    const float nearness = picture
                               .interpolated(static_cast<float>(place.x + view_.origin_x),
                                             static_cast<float>(place.y + view_.origin_y), 0)
                               .w;
    // place + t · behind, all divided by t, so that t may be infinite.
    const double inverse_t = nearness <= 0 ? 0 : forward * nearness / std::max(1 - from * nearness, 1e-6);
    if (view_.is_orthographic) {
      const glm::dvec3 end = sight.place_ws - view_.eye_ws + behind / std::max(inverse_t, 1e-6);
      place = {glm::dot(view_.x_row, end) + view_.x_add, glm::dot(view_.y_row, end) + view_.y_add};
    } else {
      const glm::dvec3 end = (sight.place_ws - view_.eye_ws) * inverse_t + behind;
      place = glm::dvec2(glm::dot(view_.x_row, end), glm::dot(view_.y_row, end)) / glm::dot(view_.w_row, end);
    }
  }
  return place + glm::dvec2(view_.origin_x, view_.origin_y);
}

// The mean over rays of a cone about the mirrored one. Behind the mirror by t they meet the picture on a circle whose radius
// grows with t, and each is followed outward to the first place whose depth belongs to that radius or a smaller one. So contacts
// stay sharp, and what lies nearer to the mirror than what it stands before is the sharper.
glm::vec3 MirrorShader::blurred(const MirrorPicture& picture, const MirrorSample& sample, float x,
                                float y) const {
  constexpr int kSteps = 7;
  // A roughness r spreads mirrored rays about twice as far as facets are tilted, whose slopes are about r² (GGX).
  const float spread = 2 * picture.mirror().roughness * picture.mirror().roughness;
  const Projection& p = view_.view.projection;
  const auto pixels_per_tangent = static_cast<float>(view_.width / (p.right - p.left));
  const auto mirror_at = static_cast<float>(view_.distance_from_reversed(sample.q));
  const auto radius_of = [&](const glm::vec4& tap) {
    if (view_.is_orthographic) {
      const float distance = tap.w > 0 ? 1 / tap.w : static_cast<float>(p.far);
      return spread * pixels_per_tangent * std::max(distance - mirror_at, 0.0F);
    }
    return spread * pixels_per_tangent * std::clamp(1 - tap.w * mirror_at, 0.0F, 1.0F);
  };
  const float widest = spread * pixels_per_tangent *
                       (view_.is_orthographic ? std::max(static_cast<float>(p.far) - mirror_at, 0.0F) : 1.0F);
  // Between pixels of different depth there is nothing: the nearest pixel is what is there.
  const auto look = [&](const glm::vec2& ray, float radius) {
    return picture.at(static_cast<int>(std::floor(x + ray.x * radius)),
                      static_cast<int>(std::floor(y + ray.y * radius)));
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

Mirroring MirrorShader::reflect(const MirrorPicture& picture, const MirrorSample& sample) const {
  const Mirror& mirror = picture.mirror();
  const glm::dvec3 ray = view_.is_orthographic
                             ? -view_.axis_ws
                             : view_.direction_0 + view_.direction_x * static_cast<double>(sample.x) +
                                   view_.direction_y * static_cast<double>(sample.y);
  Sight sight{ray / glm::length(ray), {}, 0};
  const auto cosine_to = [&](const glm::dvec3& normal) {
    return std::clamp(-glm::dot(sight.along_ws, normal), 0.0, 1.0);
  };
  if (mirror.waves.empty()) {
    const glm::vec3 share = share_of(mirror, cosine_to(picture.normal_ws()));
    if (mirror.roughness == 0) return {glm::vec3(picture.at(sample.pixel_x, sample.pixel_y)), share};
    return {blurred(picture, sample, static_cast<float>(sample.pixel_x) + 0.5F,
                    static_cast<float>(sample.pixel_y) + 0.5F),
            share};
  }
  const double distance = view_.distance_from_reversed(sample.q);
  if (view_.is_orthographic) {
    sight.place_ws = view_.direction_0 + view_.direction_x * static_cast<double>(sample.x) +
                     view_.direction_y * static_cast<double>(sample.y) +
                     view_.axis_ws * static_cast<double>(sample.q);
  } else {
    sight.place_ws = view_.eye_ws + ray * distance;
  }
  const double pixel = glm::length(view_.direction_y) * (view_.is_orthographic ? 1 : distance);
  sight.footprint = pixel / std::max(cosine_to(picture.normal_ws()), 1e-3);
  const glm::dvec3 normal = normal_on_waves(picture, sight);
  const glm::vec3 share = share_of(mirror, cosine_to(normal));
  const glm::vec2 place = displaced(picture, sample, sight, normal);
  if (mirror.roughness > 0) return {blurred(picture, sample, place.x, place.y), share};
  return {glm::vec3(picture.interpolated(place.x, place.y, 0)), share};
}

}  // namespace laterna::shade
