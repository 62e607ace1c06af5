#include "shade/refracted_ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/elementary.h"

namespace laterna::shade {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::optional<glm::dvec3> refracted(const glm::dvec3& along, const glm::dvec3& normal, double index) {
  const double cosine = std::max(-glm::dot(along, normal), 0.0), eta = 1 / index;
  const double squared = 1 - eta * eta * (1 - cosine * cosine);
  if (squared < 0) return std::nullopt;
  return glm::normalize(eta * along + (eta * cosine - std::sqrt(squared)) * normal);
}

glm::vec3 attenuation(const MirrorVolume& volume, double metres) {
  const double lengths = metres / static_cast<double>(volume.attenuation_distance);
  glm::vec3 share(1);
  for (int i = 0; i < 3; ++i) {
    const float color = volume.attenuation_color[i];
    if (color < 1 && lengths > 0) share[i] = lengths < 1e6 ? static_cast<float>(power(color, lengths)) : 0.0F;
  }
  return share;
}

RefractedRay::RefractedRay(const MirrorPicture& picture, const raster::RasterView& view,
                           const glm::dvec3& place_ws, const glm::dvec3& direction_ws, glm::vec2 sampled_at)
    : picture_(picture),
      view_(view),
      from_(place_ws - view.eye_ws),
      direction_(direction_ws),
      origin_(glm::dvec2(view.origin_x, view.origin_y) - glm::dvec2(sampled_at)),
      sinking_(std::max(-glm::dot(picture.normal_ws(), direction_ws), 1e-3)) {
  const glm::dvec3 forward = view.view.pose.forward_ws();
  start_ = glm::dot(forward, from_);
  advance_ = glm::dot(forward, direction_);
}

RefractedRay::Point RefractedRay::at(double t) const {
  const glm::dvec3 point = from_ + t * direction_;
  const glm::dvec2 image(glm::dot(view_.x_row, point), glm::dot(view_.y_row, point));
  const double distance = start_ + t * advance_;
  const glm::dvec2 place =
      view_.is_orthographic ? image + glm::dvec2(view_.x_add, view_.y_add) : image / distance;
  return {glm::vec2(place + origin_), distance};
}

double RefractedRay::behind(const Point& point) const {
  const float nearness = picture_.nearness(point.place.x, point.place.y);
  return nearness <= 0 ? -kInfinity : point.distance - 1 / static_cast<double>(nearness);
}

// By halving, and along the chord of what is left. Where what the picture shows lies much nearer than the ray still, the ray has
// passed it by.
std::optional<double> RefractedRay::meets(double before, double after) const {
  constexpr int kHalvings = 6;
  const double step = after - before;
  double gap_before = behind(at(before)), gap_after = behind(at(after));
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (before + after), gap = behind(at(middle));
    (gap >= 0 ? after : before) = middle;
    (gap >= 0 ? gap_after : gap_before) = gap;
  }
  if (gap_after > 0.1 * step) return std::nullopt;
  if (gap_before == -kInfinity || gap_after <= gap_before) return after;
  return before + (after - before) * (-gap_before / (gap_after - gap_before));
}

// The way to what lies deepest, and no farther than where the eye could not look.
double RefractedRay::most() const {
  const double deepest = 1.01 * picture_.deepest() / sinking_;
  if (view_.is_orthographic || advance_ >= 0) return deepest;
  return std::min(deepest, 0.99 * start_ / -advance_);
}

std::optional<double> RefractedRay::as_deep_as_seen_at(double t) const {
  const Point point = at(t);
  const float nearness = picture_.nearness(point.place.x, point.place.y);
  if (nearness <= 0) return std::nullopt;
  const double distance = 1 / static_cast<double>(nearness);
  const glm::dvec3 on_way = from_ + t * direction_;
  const glm::dvec3 seen = view_.is_orthographic ? on_way - view_.axis_ws * (distance - point.distance)
                                                : on_way * (distance / point.distance);
  return std::min(picture_.side(view_.eye_ws + seen) / sinking_, most());
}

RefractedRay::End RefractedRay::endless() const {
  if (view_.is_orthographic || advance_ <= 1e-6) return {at(0).place, kInfinity};
  const glm::dvec2 image(glm::dot(view_.x_row, direction_), glm::dot(view_.y_row, direction_));
  return {glm::vec2(image / advance_ + origin_), kInfinity};
}

// In steps of about two pixels, as far as that comes to no more than so many.
RefractedRay::End RefractedRay::find_end() const {
  constexpr int kMostSteps = 32;
  const double most = this->most();
  if (most <= 0) return endless();
  const float way = glm::length(at(most).place - at(0).place);
  const int steps = static_cast<int>(std::clamp(std::ceil(way / 2), 2.0F, static_cast<float>(kMostSteps)));
  bool is_ahead = true;
  std::optional<double> last_seen;  // before it first passed behind something
  for (int step = 1; step <= steps; ++step) {
    const double before = most * (step - 1) / steps, t = most * step / steps;
    const bool is_behind = behind(at(t)) >= 0;
    if (is_ahead && is_behind) {
      if (const std::optional<double> end = meets(before, t)) return {at(*end).place, *end};
      if (!last_seen) last_seen = before;
    }
    is_ahead = !is_behind;
  }
  const std::optional<double> t = as_deep_as_seen_at(last_seen.value_or(0));
  if (!t) return endless();
  const glm::vec2 place = at(*t).place;
  return {last_seen && *t > *last_seen ? 2.0F * at(*last_seen).place - place : place, *t};
}

}  // namespace laterna::shade
