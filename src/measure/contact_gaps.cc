#include "measure/contact_gaps.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <tuple>

#include "measure/shadow_boundaries.h"

namespace laterna::measure {
namespace {

// Rays start this share of a pixel off their surface.
constexpr double kStart = 1e-3;

// Texels between the pixels of a contact.
constexpr float kMostBetween = 2;

constexpr int kAround[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// A caster on the pixel itself, as far as pixels and texels can tell.
bool is_touched(const LitPixels& pixels, std::size_t i) {
  const PictureSurface& surface = pixels.surface();
  return pixels.is_blocked(glm::dvec3(surface.position_ws[i]), kStart * surface.spacing[i],
                           pixels[i].footprint + surface.spacing[i]);
}

class ContactGaps {
 public:
  ContactGaps(const LitPixels& pixels, const Mask& truth, const Mask& mask)
      : pixels_(pixels),
        surface_(pixels.surface()),
        // Where a caster stands on its receiver, one side of it may be lit and the other dark: that is no shadow's end.
        boundaries_(pixels, truth, [&pixels](std::size_t dark) { return !is_touched(pixels, dark); }),
        truth_(truth),
        mask_(mask),
        distances_(mask.size(), kUnreached) {}

  double largest() {
    for (int y = 0; y < surface_.height; ++y) {
      for (int x = 0; x < surface_.width; ++x) find_contact(x, y);
    }
    float largest = 0;
    // The nearest first, so that each pixel is measured from the contact nearest to it.
    while (!reached_.empty()) {
      const Reached at = reached_.top();
      reached_.pop();
      const std::size_t here = surface_.index(at.x, at.y);
      if (at.distance > distances_[here]) continue;
      largest = std::max(largest, at.distance);
      for (const auto& [dx, dy] : kAround) {
        if (!surface_.contains(at.x + dx, at.y + dy)) continue;
        const std::size_t next = surface_.index(at.x + dx, at.y + dy);
        if (pixels_[next].face == pixels_[here].face && surface_.is_continuous(here, next))
          reach(at.x + dx, at.y + dy, at.contact);
      }
    }
    return static_cast<double>(largest);
  }

 private:
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  struct Reached {
    float distance;  // texels from the contact
    int x, y;
    glm::vec2 contact;  // in texels
    bool operator<(const Reached& other) const {
      return std::tie(distance, y, x) > std::tie(other.distance, other.y, other.x);
    }
  };

  [[nodiscard]] bool is_false_light(std::size_t i) const {
    return pixels_.is_counted(i) && is_lit(mask_[i]) && !is_lit(truth_[i]);
  }

  void reach(int x, int y, const glm::vec2& contact) {
    const std::size_t i = surface_.index(x, y);
    const float distance = glm::distance(contact, pixels_[i].texel);
    if (distance >= distances_[i] || !is_false_light(i)) return;
    if (boundaries_.distance_from(i, kEdgeTexels) <= kEdgeTexels) return;
    distances_[i] = distance;
    reached_.push({distance, x, y, contact});
  }

  void find_contact(int x, int y) {
    const std::size_t here = surface_.index(x, y);
    if (!is_false_light(here)) return;
    const glm::dvec3 point_ws(surface_.position_ws[here]);
    const double spacing = surface_.spacing[here];
    for (const auto& [dx, dy] : kAround) {
      if (!surface_.contains(x + dx, y + dy)) continue;
      const std::size_t next = surface_.index(x + dx, y + dy);
      if (!do_touch(here, next)) continue;
      // A pixel beside a wall may lie in the shadow of a roof far off.
      const double reach_m = 8 * (pixels_[here].footprint + spacing + surface_.spacing[next]);
      if (!pixels_.is_blocked(point_ws, kStart * spacing, reach_m)) continue;
      const glm::vec2 other(pixels_.texel_of(pixels_[here].face, glm::dvec3(surface_.position_ws[next])));
      // Where pixels are many texels apart, the picture does not show where between them the contact is.
      if (glm::distance(other, pixels_[here].texel) > kMostBetween) continue;
      reach(x, y, 0.5F * (pixels_[here].texel + other));
      return;
    }
    // What touches may be out of sight.
    if (is_touched(pixels_, here)) reach(x, y, pixels_[here].texel);
  }

  // Two surfaces that meet as floor and wall do, each in front of the other.
  [[nodiscard]] bool do_touch(std::size_t a, std::size_t b) const {
    if (surface_.object[b] < 0) return false;
    constexpr float kSamePlane = 0.9F;  // cosine
    const glm::vec3 step = surface_.position_ws[b] - surface_.position_ws[a];
    const float apart = surface_.spacing[a] + surface_.spacing[b];
    const float slack = -0.05F * apart;
    return glm::dot(surface_.normal_ws[a], surface_.normal_ws[b]) < kSamePlane &&
           glm::length(step) <= 1.5F * apart && glm::dot(step, surface_.normal_ws[a]) >= slack &&
           -glm::dot(step, surface_.normal_ws[b]) >= slack;
  }

  const LitPixels& pixels_;
  const PictureSurface& surface_;
  ShadowBoundaries boundaries_;
  const Mask& truth_;
  const Mask& mask_;
  std::vector<float> distances_;  // texels from the nearest contact so far
  std::priority_queue<Reached> reached_;
};

}  // namespace

double largest_contact_gap(const LitPixels& pixels, const Mask& truth, const Mask& mask) {
  return ContactGaps(pixels, truth, mask).largest();
}

}  // namespace laterna::measure
