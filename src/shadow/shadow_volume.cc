#include "shadow/shadow_volume.h"

#include "shadow/exact_crossing.h"
#include "shadow/nearest_blocker.h"

namespace laterna::shadow {

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
    const glm::dvec3 position(position_of(i));
    nearest_[i] = nearest_blocker(samples_, i);
    if (!(nearest_[i] < volume_.light_.length_at(position))) return false;
    const glm::dvec3 start = position + volume_.light_.toward_at(position) * static_cast<double>(nearest_[i]);
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
    if (darkens(volume_.frame_, volume_.light_, position_of(i), nearest_[i], caster)) here_.count[i] += 1;
  }

  // Where the light only grazes it, a sample's own triangle may lie in its way, by rounding. That does not count.
  [[nodiscard]] bool is_dark(std::size_t i) const {
    if (here_.count[i] <= 0) return false;
    if (here_.count[i] > 1 || !casts_as_a_whole(samples_.id[i])) return true;
    return !darkens(volume_.frame_, volume_.light_, position_of(i), nearest_[i], samples_.id[i]);
  }

  // As part of the surface that all such triangles make, in which it is counted.
  [[nodiscard]] bool casts_as_a_whole(TriangleId id) const {
    if (id == kNoTriangle) return false;
    const Cluster& cluster = volume_.frame_.clusters[cluster_of(id)];
    return is_opaque_caster(cluster) && (cluster.flags & kAlphaMask) == 0;
  }

  [[nodiscard]] glm::vec3 position_of(std::size_t i) const {
    return {samples_.x_ws[i], samples_.y_ws[i], samples_.z_ws[i]};
  }

  const ShadowVolume& volume_;
  const SurfaceSamples& samples_;
  VolumeSamples here_;
  std::array<float, kMaxSamples> nearest_;  // metres: casters nearer to the sample do not count
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
