#include "measure/contact_gaps.h"

#include <algorithm>
#include <deque>
#include <glm/geometric.hpp>
#include <optional>

namespace laterna::measure {
namespace {

constexpr int kAround[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

class ContactGaps {
 public:
  ContactGaps(const LitPixels& pixels, const ShadowBoundaries& boundaries, const Mask& truth,
              const Mask& mask)
      : pixels_(pixels),
        surface_(pixels.surface()),
        boundaries_(boundaries),
        truth_(truth),
        mask_(mask),
        contacts_(mask.size()) {}

  double largest() {
    for (int y = 0; y < surface_.height; ++y) {
      for (int x = 0; x < surface_.width; ++x) find_contact(x, y);
    }
    double largest = 0;
    // Each pixel takes over the contact of the one from which it was reached first.
    while (!reached_.empty()) {
      const auto [x, y] = reached_.front();
      reached_.pop_front();
      const std::size_t here = surface_.index(x, y);
      const glm::vec2 contact = *contacts_[here];
      largest = std::max(largest, static_cast<double>(glm::distance(contact, pixels_[here].texel)));
      for (const auto& [dx, dy] : kAround) {
        if (!surface_.contains(x + dx, y + dy)) continue;
        const std::size_t next = surface_.index(x + dx, y + dy);
        if (pixels_[next].face == pixels_[here].face && surface_.is_continuous(here, next))
          reach(x + dx, y + dy, contact);
      }
    }
    return largest;
  }

 private:
  [[nodiscard]] bool is_false_light(std::size_t i) const {
    return pixels_.is_counted(i) && is_lit(mask_[i]) && !is_lit(truth_[i]);
  }

  void reach(int x, int y, const glm::vec2& contact) {
    const std::size_t i = surface_.index(x, y);
    if (contacts_[i] || !is_false_light(i)) return;
    if (boundaries_.distance_from(i, kEdgeTexels) <= kEdgeTexels) return;
    contacts_[i] = contact;
    reached_.emplace_back(x, y);
  }

  void find_contact(int x, int y) {
    const std::size_t here = surface_.index(x, y);
    if (!is_false_light(here)) return;
    const glm::dvec3 point_ws(surface_.position_ws[here]);
    const double spacing = surface_.spacing[here];
    const double blocker = pixels_.blocker_distance(point_ws, 1e-3 * spacing);
    for (const auto& [dx, dy] : kAround) {
      if (!surface_.contains(x + dx, y + dy)) continue;
      const std::size_t next = surface_.index(x + dx, y + dy);
      if (!do_touch(here, next)) continue;
      // A pixel beside a wall may lie in the shadow of a roof far off.
      if (blocker > 8 * (pixels_[here].footprint + spacing + surface_.spacing[next])) continue;
      const glm::dvec3 between = 0.5 * (point_ws + glm::dvec3(surface_.position_ws[next]));
      reach(x, y, glm::vec2(pixels_.texel_of(pixels_[here].face, between)));
      return;
    }
    // What touches may be out of sight.
    if (blocker <= pixels_[here].footprint + spacing) reach(x, y, pixels_[here].texel);
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
  const ShadowBoundaries& boundaries_;
  const Mask& truth_;
  const Mask& mask_;
  std::vector<std::optional<glm::vec2>> contacts_;  // in texels, where reached
  std::deque<std::pair<int, int>> reached_;
};

}  // namespace

double largest_contact_gap(const LitPixels& pixels, const ShadowBoundaries& boundaries, const Mask& truth,
                           const Mask& mask) {
  return ContactGaps(pixels, boundaries, truth, mask).largest();
}

}  // namespace laterna::measure
