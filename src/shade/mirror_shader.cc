#include "shade/mirror_shader.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "shade/fresnel.h"
#include "shade/mirror_blur.h"
#include "shade/picture_ray.h"
#include "shade/refraction.h"
#include "shade/water_waves.h"

namespace laterna::shade {
namespace {

// How much slower light goes behind the surface than before it, as seen from the eye.
double index_of(const MirrorPicture& picture) {
  const double ior = *picture.mirror().ior;
  return picture.mirror().volume && picture.sees_back() ? 1 / ior : ior;
}

glm::vec3 share_of(const MirrorPicture& picture, double cosine) {
  const Mirror& mirror = picture.mirror();
  if (mirror.ior)
    return mirror.reflectance * static_cast<float>(fresnel_reflectance(cosine, index_of(picture)));
  return mirror.reflectance +
         (glm::vec3(1) - mirror.reflectance) * static_cast<float>(schlick_weight(cosine));
}

double cosine_to(const glm::dvec3& normal_ws, const glm::dvec3& along_ws) {
  return std::clamp(-glm::dot(along_ws, normal_ws), 0.0, 1.0);
}

}  // namespace

glm::dvec3 MirrorShader::ray_of(const MirrorSample& sample) const {
  if (view_.is_orthographic) return -view_.axis_ws;
  return view_.direction_0 + view_.direction_x * static_cast<double>(sample.x) +
         view_.direction_y * static_cast<double>(sample.y);
}

MirrorShader::Sight MirrorShader::sight_of(const MirrorPicture& picture, const MirrorSample& sample) const {
  const glm::dvec3 ray = ray_of(sample);
  Sight sight{ray / glm::length(ray), {}, view_.distance_from_reversed(sample.q), 0};
  if (view_.is_orthographic) {
    sight.place_ws = view_.direction_0 + view_.direction_x * static_cast<double>(sample.x) +
                     view_.direction_y * static_cast<double>(sample.y) +
                     view_.axis_ws * static_cast<double>(sample.q);
  } else {
    sight.place_ws = view_.eye_ws + ray * sight.distance;
  }
  const double pixel = glm::length(view_.direction_y) * (view_.is_orthographic ? 1 : sight.distance);
  sight.footprint = pixel / std::max(cosine_to(picture.normal_ws(), sight.along_ws), 1e-3);
  return sight;
}

// Where in the picture the ray from a place of the mirror ends that its waves send elsewhere: the ray is mirrored in the plane,
// into the space that the picture seems to show, and followed there.
glm::vec2 MirrorShader::displaced(const MirrorPicture& picture, const Sight& sight,
                                  const glm::dvec3& normal_ws) const {
  const glm::dvec3& n = picture.normal_ws();
  const glm::dvec3 reflected = sight.along_ws - 2 * glm::dot(sight.along_ws, normal_ws) * normal_ws;
  // Not into the water: a ray that would meets another wave, and goes on.
  const glm::dvec3 behind = reflected - (glm::dot(reflected, n) + std::abs(glm::dot(reflected, n))) * n;
  return PictureRay(picture, view_, sight.place_ws, behind, sampled_at_).find_end_in_sight();
}

// A roughness r spreads mirrored rays about twice as far as facets are tilted, whose slopes are about r² (GGX).
glm::vec3 MirrorShader::rough(const MirrorPicture& picture, const MirrorSample& sample, float x,
                              float y) const {
  const float spread = 2 * picture.mirror().roughness * picture.mirror().roughness;
  return blurred(picture, view_, spread, static_cast<float>(view_.distance_from_reversed(sample.q)), x, y);
}

Mirroring MirrorShader::reflect(const MirrorPicture& picture, const MirrorSample& sample) const {
  const Mirror& mirror = picture.mirror();
  if (mirror.waves.empty()) {
    const glm::dvec3 ray = ray_of(sample);
    const glm::vec3 share = share_of(picture, cosine_to(picture.normal_ws(), ray / glm::length(ray)));
    if (mirror.roughness == 0)
      return {picture.at_sample(sample.pixel_x, sample.pixel_y, sample.number), share};
    return {rough(picture, sample, static_cast<float>(sample.pixel_x) + 0.5F,
                  static_cast<float>(sample.pixel_y) + 0.5F),
            share};
  }
  const Sight sight = sight_of(picture, sample);
  const glm::dvec3 normal =
      normal_on_waves(mirror, picture.normal_ws(), sight.place_ws, sight.footprint, picture.seconds());
  const glm::vec3 share = share_of(picture, cosine_to(normal, sight.along_ws));
  const glm::vec2 place = displaced(picture, sight, normal);
  if (mirror.roughness > 0) return {rough(picture, sample, place.x, place.y), share};
  return {glm::vec3(picture.on_surface(place.x, place.y)), share};
}

glm::vec3 MirrorShader::refract(const MirrorPicture& picture, const MirrorSample& sample) const {
  const Mirror& mirror = picture.mirror();
  const Sight sight = sight_of(picture, sample);
  const glm::dvec3 normal =
      normal_on_waves(mirror, picture.normal_ws(), sight.place_ws, sight.footprint, picture.seconds());
  const double index = index_of(picture);
  const std::optional<glm::dvec3> direction = refracted(sight.along_ws, normal, index);
  if (!direction) return glm::vec3(0);  // all of it is mirrored
  const PictureRay ray(picture, picture.drawn(), sight.place_ws, *direction, sampled_at_);
  const PictureRay::End end = ray.find_end();
  const glm::vec3 share = picture.sees_back() ? glm::vec3(1) : attenuation(*mirror.volume, end.distance);
  if (mirror.roughness == 0) return share * glm::vec3(picture.on_surface(end.place.x, end.place.y));
  // A facet that is tilted by an angle turns what it refracts by (1 − 1/n) of it, and what it mirrors by twice of it.
  const auto bend = static_cast<float>(std::abs(1 - 1 / index));
  return share * blurred(picture, picture.drawn(), bend * mirror.roughness * mirror.roughness,
                         static_cast<float>(ray.start()), end.place.x, end.place.y);
}

}  // namespace laterna::shade
