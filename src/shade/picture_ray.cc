#include "shade/picture_ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace laterna::shade {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kMostLeap = 0.05F;  // of the nearer depth, of one surface from look to look
constexpr float kContact = 2;       // pixels of the way to what stands on the mirror

}  // namespace

PictureRay::PictureRay(const MirrorPicture& picture, const raster::RasterView& view,
                       const glm::dvec3& place_ws, const glm::dvec3& direction_ws, glm::vec2 sampled_at)
    : picture_(picture),
      view_(view),
      from_(place_ws - view_.eye_ws),
      direction_(direction_ws),
      origin_(glm::dvec2(view_.origin_x, view_.origin_y) - glm::dvec2(sampled_at)),
      sinking_(std::max(-glm::dot(picture.normal_ws(), direction_ws), 1e-3)) {
  const glm::dvec3 forward = view_.view.pose.forward_ws();
  start_ = glm::dot(forward, from_);
  advance_ = glm::dot(forward, direction_);
}

PictureRay::Point PictureRay::at(double t) const {
  const glm::dvec3 point = from_ + t * direction_;
  const glm::dvec2 image(glm::dot(view_.x_row, point), glm::dot(view_.y_row, point));
  const double distance = start_ + t * advance_;
  const glm::dvec2 place =
      view_.is_orthographic ? image + glm::dvec2(view_.x_add, view_.y_add) : image / distance;
  return {glm::vec2(place + origin_), distance};
}

glm::vec2 PictureRay::place_as_near_as(float nearness) const {
  // from + t · direction, all divided by t, so that t may be infinite.
  const double inverse_t = nearness <= 0 ? 0 : advance_ * nearness / std::max(1 - start_ * nearness, 1e-6);
  if (view_.is_orthographic) return at(1 / std::max(inverse_t, 1e-6)).place;
  const glm::dvec3 end = from_ * inverse_t + direction_;
  const glm::dvec2 image(glm::dot(view_.x_row, end), glm::dot(view_.y_row, end));
  return glm::vec2(image / (start_ * inverse_t + advance_) + origin_);
}

double PictureRay::behind(const Point& point) const {
  const float nearness = picture_.nearness(point.place.x, point.place.y);
  return nearness <= 0 ? -kInfinity : point.distance - 1 / static_cast<double>(nearness);
}

// By halving, and along the chord of what is left. Where what the picture shows lies much nearer than the ray still, the ray has
// passed it by.
std::optional<double> PictureRay::meets(double before, double after) const {
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

// At the foot of what stands on the mirror a ray close to the mirror leaves what it would meet a little farther on, for where the picture
// ends.
std::optional<glm::vec2> PictureRay::meets_foot(glm::dvec2 open) const {
  constexpr int kHalvings = 6;
  if (open.y == 0) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (open.x + open.y);
    (behind(at(middle)) == -kInfinity ? open.y : open.x) = middle;
  }
  const glm::vec2 place = at(open.x).place;
  const glm::vec2 met = place_as_near_as(picture_.nearness(place.x, place.y));
  if (glm::length(met - place) >= kContact) return std::nullopt;
  // A pixel back, as the last one is the mean of what is met and of nothing.
  const glm::vec2 back = at(0).place - place;
  return place + back / std::max(glm::length(back), 1.0F);
}

// The way to what lies deepest, and no farther than where the eye could not look.
double PictureRay::most() const {
  const double deepest = 1.01 * picture_.deepest() / sinking_;
  if (view_.is_orthographic || advance_ >= 0) return deepest;
  return std::min(deepest, 0.99 * start_ / -advance_);
}

std::optional<double> PictureRay::as_deep_as_seen_at(double t) const {
  const Point point = at(t);
  const float nearness = picture_.nearness(point.place.x, point.place.y);
  if (nearness <= 0) return std::nullopt;
  const double distance = 1 / static_cast<double>(nearness);
  const glm::dvec3 on_way = from_ + t * direction_;
  const glm::dvec3 seen = view_.is_orthographic ? on_way - view_.axis_ws * (distance - point.distance)
                                                : on_way * (distance / point.distance);
  return std::min(picture_.metres_behind(view_.eye_ws + seen) / sinking_, most());
}

PictureRay::End PictureRay::endless() const {
  if (view_.is_orthographic || advance_ <= 1e-6) return {at(0).place, kInfinity};
  const glm::dvec2 image(glm::dot(view_.x_row, direction_), glm::dot(view_.y_row, direction_));
  return {glm::vec2(image / advance_ + origin_), kInfinity};
}

// On the last pixel before the foot of something some of the picture's samples see that, and the one whose depth is kept what lies behind.
std::optional<glm::vec2> PictureRay::foot_beside() const {
  const glm::vec2 start = at(0).place;
  const float own = picture_.nearest(start.x, start.y).w;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::vec2 beside = glm::floor(start) + glm::vec2(dx, dy) + 0.5F;
      const float nearness = picture_.nearest(beside.x, beside.y).w;
      const bool leaps = nearness - own > kMostLeap * nearness;
      if (leaps && glm::length(place_as_near_as(nearness) - start) < kContact) return beside;
    }
  }
  return std::nullopt;
}

// The depth is taken at the start first, then where that leads, and there again.
std::optional<glm::vec2> PictureRay::find_end_on_one_surface() const {
  glm::vec2 place = at(0).place;
  if (advance_ <= 1e-3) return place;
  float nearness = picture_.nearness(place.x, place.y);
  for (int look = 0; look < 2; ++look) {
    place = place_as_near_as(nearness);
    const float there = picture_.nearness(place.x, place.y);
    if (std::abs(there - nearness) > kMostLeap * std::max(there, nearness)) return std::nullopt;
    nearness = there;
  }
  return place;
}

// In steps of about two pixels, as far as that comes to no more than so many. The first is taken in quarters: of what stands there no
// more than a rim may be shown.
PictureRay::March PictureRay::march(double most) const {
  constexpr int kMostSteps = 32, kQuarters = 4;
  const float way = glm::length(at(most).place - at(0).place);
  const int steps = static_cast<int>(std::clamp(std::ceil(way / 2), 2.0F, static_cast<float>(kMostSteps)));
  const double first_depth = view_.is_orthographic ? 1 : start_,
               last_depth = view_.is_orthographic ? 1 : start_ + most * advance_;
  const auto after = [&](int step) {  // so that all are of one length in the picture
    const double share =
        (step < kQuarters ? step / static_cast<double>(kQuarters) : step - kQuarters + 1) / steps;
    return most * share * first_depth / (last_depth + share * (first_depth - last_depth));
  };
  bool is_ahead = true;
  March march;
  if (behind(at(0)) > -kInfinity) march.open = {0, after(1)};
  for (int step = 1; step < steps + kQuarters; ++step) {
    const double before = after(step - 1), t = after(step);
    const double gap = behind(at(t));
    const bool is_behind = gap >= 0;
    if (!is_behind && gap > -kInfinity) march.open = {t, after(step + 1)};
    if (is_ahead && is_behind) {
      march.met = meets(before, t);
      if (march.met) return march;
      if (!march.last_seen) march.last_seen = before;
    }
    is_ahead = !is_behind;
  }
  return march;
}

PictureRay::End PictureRay::find_end() const {
  // What hides the start is what stands there: no more than its foot is shown of what is before the plane (MirrorView::margin).
  if (behind(at(0)) >= 0) return {at(0).place, 0};
  const double most = this->most();
  if (most <= 0) return endless();
  const March march = this->march(most);
  if (march.met) return {at(*march.met).place, *march.met};
  const std::optional<double> t = as_deep_as_seen_at(march.last_seen.value_or(0));
  if (!t) return endless();
  const glm::vec2 place = at(*t).place;
  return {march.last_seen && *t > *march.last_seen ? 2.0F * at(*march.last_seen).place - place : place, *t};
}

glm::vec2 PictureRay::find_end_in_sight() const {
  if (picture_.needs_samples()) {
    if (const std::optional<glm::vec2> foot = foot_beside()) return *foot;
  }
  if (const std::optional<glm::vec2> end = find_end_on_one_surface()) return *end;
  const double most = this->most();
  if (most <= 0) return endless().place;
  const March march = this->march(most);
  if (march.met) return at(*march.met).place;
  if (const std::optional<glm::vec2> foot = meets_foot(march.open)) return *foot;
  const glm::vec2 place = endless().place;
  if (picture_.nearness(place.x, place.y) <= 0) return place;
  // The middle of its pixel, as the next one shows what hides the ray.
  return glm::floor(at(march.last_seen.value_or(most)).place) + 0.5F;
}

}  // namespace laterna::shade
