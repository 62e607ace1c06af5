#include "shadow/shadow_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "frame/surface_alpha.h"
#include "shadow/nearest_blocker.h"

namespace laterna::shadow {
namespace {

// From a sample to the light.
struct Way {
  glm::dvec3 toward_ws{0};  // unit
  double length = 0;        // to the light, or to where its near plane begins
  double nearest = 0;       // casters nearer to the sample do not count
  [[nodiscard]] bool is_free() const { return nearest >= length; }
};

Way way_to_light(const VolumeLight& light, const glm::dvec3& position_ws, double nearest) {
  const glm::dvec3 away = light.direction_at(position_ws);
  const double distance = glm::length(away);
  if (!(distance > 0)) return {};
  Way way;
  way.toward_ws = -away / distance;
  way.nearest = nearest;
  way.length = light.is_parallel ? std::numeric_limits<double>::infinity() : distance;
  if (light.has_near) {
    // Along the axis, and then along the ray.
    const double beyond = light.beyond_near(position_ws);
    way.length = light.is_parallel ? beyond : distance * beyond / (beyond + light.near);
    if (beyond <= 0) way.length = 0;
  }
  return way;
}

// Where a way meets a triangle.
struct Meeting {
  bool is_there = false;
  float b = 0, c = 0;  // weights of the second and third corner
};

// The sides of an edge are the same number, but for the sign, for both triangles that share it.
Meeting meet(const frame::Frame& frame, TriangleId id, const glm::dvec3& position_ws, const Way& way) {
  const Cluster& cluster = frame.clusters[cluster_of(id)];
  const std::uint32_t packed = frame.corners[id];
  const auto corner = [&](unsigned k) {
    const std::uint32_t v = cluster.first_vertex + (packed >> (8 * k) & 255U);
    return glm::dvec3(frame.x_ws[v], frame.y_ws[v], frame.z_ws[v]) - position_ws;
  };
  const glm::dvec3 a = corner(0);
  const glm::dvec3 b = corner(1);
  const glm::dvec3 c = corner(2);
  const double at_a = glm::dot(way.toward_ws, glm::cross(b, c));
  const double at_b = glm::dot(way.toward_ws, glm::cross(c, a));
  const double at_c = glm::dot(way.toward_ws, glm::cross(a, b));
  const bool is_within = (at_a >= 0 && at_b >= 0 && at_c >= 0) || (at_a <= 0 && at_b <= 0 && at_c <= 0);
  const double sum = at_a + at_b + at_c;
  if (!is_within || sum == 0) return {};
  const double distance = glm::dot(a, glm::cross(b, c)) / sum;
  if (distance < way.nearest || distance > way.length) return {};
  return {true, static_cast<float>(at_b / sum), static_cast<float>(at_c / sum)};
}

bool is_opaque(const frame::Frame& frame, TriangleId id, const Meeting& meeting) {
  return frame::alpha_at(frame, id, meeting.b, meeting.c) >=
         frame.surfaces[frame.clusters[cluster_of(id)].material].alpha_cutoff;
}

}  // namespace

// Counts for one batch of samples, tile by tile of where their lines of sight pass.
class ShadowVolume::Counter {
 public:
  Counter(const ShadowVolume& volume, const SurfaceSamples& samples) : volume_(volume), samples_(samples) {}

  void find_arrival(std::span<const std::uint16_t> wanted, Arrival& arrival) {
    place_samples(wanted);
    for (std::size_t group = 0; group < samples_.group_count; ++group) {
      while (left_[group] != 0) {
        const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(left_[group]));
        if (const int tile = places_[i].tile; tile >= 0) {
          count_in_tile(tile, group);
        } else {
          count_everywhere(i);
          left_[group] = static_cast<std::uint16_t>(left_[group] & (left_[group] - 1U));
        }
      }
    }
    for (std::size_t i = 0; i < samples_.group_count * kGroupSize; ++i)
      arrival.alpha[i] = is_dark(i) ? 0.0F : 1.0F;
  }

 private:
  // A sample is asked about where what may shadow it begins, so that neighbours of its triangle are not in its way. Lines
  // of sight go through these places.
  void place_samples(std::span<const std::uint16_t> wanted) {
    for (std::size_t group = 0; group < samples_.group_count; ++group) {
      for (unsigned mask = wanted[group]; mask != 0; mask &= mask - 1) {
        const auto k = static_cast<unsigned>(__builtin_ctz(mask));
        const std::size_t i = group * kGroupSize + k;
        if (place(i)) left_[group] = static_cast<std::uint16_t>(left_[group] | 1U << k);
      }
    }
  }

  bool place(std::size_t i) {
    const glm::dvec3 position(samples_.x_ws[i], samples_.y_ws[i], samples_.z_ws[i]);
    ways_[i] = way_to_light(volume_.light_, position, nearest_blocker(samples_, i));
    if (ways_[i].is_free()) return false;
    const glm::dvec3 start = position + ways_[i].toward_ws * ways_[i].nearest;
    here_.x_ws[i] = start.x, here_.y_ws[i] = start.y, here_.z_ws[i] = start.z;
    directions_[i] = volume_.eye_.to_point(start);
    here_.direction_x[i] = directions_[i].x;
    here_.direction_y[i] = directions_[i].y;
    here_.direction_w[i] = directions_[i].w;
    places_[i] = volume_.bins_.place_of(directions_[i]);
    return true;
  }

  void count_in_tile(int tile, std::size_t first_group) {
    here_.asked.fill(0);
    here_.cells.fill(0);
    here_.all_cells = 0;
    here_.pending.clear();
    for (std::size_t group = first_group; group < samples_.group_count; ++group) {
      for (unsigned mask = left_[group]; mask != 0; mask &= mask - 1) {
        const auto k = static_cast<unsigned>(__builtin_ctz(mask));
        const VolumeBins::Place& place = places_[group * kGroupSize + k];
        if (place.tile != tile) continue;
        here_.asked[group] = static_cast<std::uint16_t>(here_.asked[group] | 1U << k);
        here_.cells[group] |= std::uint64_t{1} << static_cast<unsigned>(place.cell);
      }
      left_[group] = static_cast<std::uint16_t>(left_[group] & ~here_.asked[group]);
      here_.all_cells |= here_.cells[group];
    }
    count_crossings_for(volume_.instruction_set_)(volume_.bins_, tile, here_);
    for (const VolumeSamples::Pending& pending : here_.pending) {
      if (pending.is_prism) {
        enter(volume_.bins_.prism(pending.index).caster, pending.sample);
      } else if (const VolumeFacet& facet = volume_.bins_.facet(pending.index);
                 volume_.bins_.is_crossed(facet, directions_[pending.sample])) {
        here_.count[pending.sample] += facet.step;
      }
    }
  }

  void count_everywhere(std::size_t i) {
    for (const VolumeTriangle& triangle : volume_.surface_.triangles()) {
      const std::optional<VolumeFacet> facet = volume_.bins_.facet_of(triangle);
      if (!facet || !is_beyond(*facet, i)) continue;
      if (volume_.bins_.is_crossed(*facet, directions_[i])) here_.count[i] += facet->step;
    }
    for (const VolumePrism& prism : volume_.surface_.prisms()) enter(prism.caster, i);
  }

  // As the kernel has it.
  [[nodiscard]] bool is_beyond(const VolumeFacet& facet, std::size_t i) const {
    const double* p = facet.plane;
    return p[0] * here_.x_ws[i] + p[1] * here_.y_ws[i] + p[2] * here_.z_ws[i] + p[3] > 0;
  }

  // The sample lies in the volume of a cut-out's triangle, or nearly.
  void enter(TriangleId caster, std::size_t i) {
    if (caster == samples_.id[i] || here_.count[i] > 1) return;
    const Meeting meeting = meet_triangle(caster, i);
    if (meeting.is_there && is_opaque(volume_.frame_, caster, meeting)) here_.count[i] += 1;
  }

  // Where the light only grazes it, a sample's own triangle may lie in its way, by rounding. That does not count.
  [[nodiscard]] bool is_dark(std::size_t i) const {
    if (here_.count[i] <= 0) return false;
    if (here_.count[i] > 1 || !casts_as_a_whole(samples_.id[i])) return true;
    return !meet_triangle(samples_.id[i], i).is_there;
  }

  // As part of the surface that all such triangles make, in which it is counted.
  [[nodiscard]] bool casts_as_a_whole(TriangleId id) const {
    if (id == kNoTriangle) return false;
    const std::uint32_t flags = volume_.frame_.clusters[cluster_of(id)].flags;
    return (flags & kCastsShadow) != 0 && (flags & (kAlphaMask | kAlphaBlend)) == 0;
  }

  [[nodiscard]] Meeting meet_triangle(TriangleId id, std::size_t i) const {
    const glm::dvec3 position(samples_.x_ws[i], samples_.y_ws[i], samples_.z_ws[i]);
    return meet(volume_.frame_, id, position, ways_[i]);
  }

  const ShadowVolume& volume_;
  const SurfaceSamples& samples_;
  VolumeSamples here_;
  std::array<Way, kMaxSamples> ways_;
  std::array<EyeDirection, kMaxSamples> directions_;
  std::array<VolumeBins::Place, kMaxSamples> places_;
  std::array<std::uint16_t, kMaxGroups> left_{};  // samples that are to be counted still
};

ShadowVolume::ShadowVolume(const light::PlannedLight& planned, const frame::Frame& frame,
                           const raster::RasterView& camera, const TaskPool& pool, InstructionSet set)
    : frame_(frame),
      light_(*planned.placed),
      surface_(frame, light_),
      eye_(camera, frame.bounds),
      bins_(surface_, light_, eye_, camera, frame.bounds, pool),
      instruction_set_(set) {}

double ShadowVolume::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                  Arrival& arrival) const {
  arrival.is_tinted = false;
  Counter(*this, samples).find_arrival(wanted, arrival);
  return 0;
}

}  // namespace laterna::shadow
