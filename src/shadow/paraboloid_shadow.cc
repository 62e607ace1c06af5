#include "shadow/paraboloid_shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shadow/nearest_blocker.h"

namespace laterna::shadow {
namespace {

// As the cube's maps have them (refinement-inl.h): within so many texel footprints and changes along the plane from one
// texel to the next, what a texel saw may be the receiver's own neighbourhood.
constexpr double kNearTexels = 1;
constexpr double kNearSlopes = 0.5;
// So many footprints beyond the receiver's plane it is not part of it.
constexpr double kBeyondTexels = 0.25;
// Triangles that the light sees smaller than this many texels may have neighbours that no texel saw.
constexpr double kSmallTexels = 2;
// From a suspect that the ray misses, so many steps are made at most toward it over the surface.
constexpr int kMostSteps = 8;
// What comparisons in single precision may be off by.
constexpr double kRounding = 1e-6;

// The pixel's centre and four places about it, no two in one row or column.
constexpr int kPlaceCount = 5;
constexpr double kPlaces[kPlaceCount][2] = {
    {0, 0}, {-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};

// Texels beyond the circle that a filter at the seam reads.
int border_of(const ShadowSettings& settings) { return 2 + settings.kernel / 2; }

// Along the sample's plane from the pixel's centre.
glm::dvec3 step_on_plane(const SurfaceSamples& s, std::size_t i, const double place[2]) {
  const raster::RasterView::Ray& ray = s.ray;
  const double h = ray.ray_0.w + ray.ray_x.w * s.x[i] + ray.ray_y.w * s.y[i] + ray.q_term.w * s.q[i];
  const double dq = place[0] * s.dq_dx[i] + place[1] * s.dq_dy[i];
  const glm::dvec4 step = ray.ray_x * place[0] + ray.ray_y * place[1] + ray.q_term * dq;
  return (glm::dvec3(step) - glm::dvec3(s.x_ws[i], s.y_ws[i], s.z_ws[i]) * step.w) / h;
}

double smooth_step(double t) { return t * t * (3 - 2 * t); }

}  // namespace

// A sample as its light sees it. Reverse distances are affine on a plane in the direction's coordinates: on the
// receiver's they are dot(plane, direction).
struct ParaboloidShadow::Receiver {
  int map;
  glm::dvec2 texel;
  double reverse;    // of its own distance
  glm::dvec3 plane;  // its triangle's
  double footprint;  // a texel's, as a change of reverse distance along the ray
  double change;     // of reverse distance along the plane, to the next texels right and down together
  double rounding;   // of reverse distances
  TriangleId id;
};

struct ParaboloidShadow::Tap {
  double stored;    // reverse distances
  double on_plane;  // of the receiver's plane, at the texel's centre
  TriangleId id;
};

// Triangles that may stand in the receiver's way: what the four texels saw, and what a walk from there passed.
struct ParaboloidShadow::Suspects {
  std::array<TriangleId, 4 * (1 + kMostSteps)> id{};
  std::size_t count = 0;
  std::array<double, 4> far_weight{};  // of texels that saw it far in front; what the texels saw comes first

  // Its place among them.
  std::size_t add(TriangleId added) {
    for (std::size_t k = 0; k < count; ++k) {
      if (id[k] == added) return k;
    }
    id[count] = added;
    return count++;
  }
};

ParaboloidPair ParaboloidShadow::pair_of(const light::PlannedLight& planned) {
  return {planned.placed->pose, planned.settings.resolution, border_of(planned.settings)};
}

ParaboloidShadow::ParaboloidShadow(const light::PlannedLight& planned,
                                   std::shared_ptr<const ParaboloidMap> map, const frame::Frame& frame,
                                   const frame::TriangleNeighbours* neighbours, int samples_per_pixel)
    : frame_(frame),
      neighbours_(neighbours),
      light_(*planned.placed),
      map_(std::move(map)),
      filter_(filter_of(planned.settings)),
      bias_(bias_of(planned.settings)),
      kernel_(planned.settings.kernel),
      positions_(samples_per_pixel > 1 ? 1 : kPlaceCount),
      soft_edge_(planned.settings.soft_edge) {
  // Where only some faces cast shadows, the map knows which; their neighbours may be of the other kind.
  const bool is_known = neighbours != nullptr && !neighbours->sources.empty();
  if (!is_known || planned.settings.caster_faces != CasterFaces::both) neighbours_ = nullptr;
}

double ParaboloidShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                      Arrival& arrival) const {
  arrival.is_tinted = false;
  for_each_sample(samples, wanted, [&](std::size_t i) {
    const bool is_refined = filter_ == ShadowFilter::refined;
    const double alpha = is_refined ? refined(samples, i) : filtered(find_receiver(samples, i));
    arrival.alpha[i] = static_cast<float>(alpha);
  });
  return 0;
}

ParaboloidShadow::Receiver ParaboloidShadow::find_receiver(const SurfaceSamples& s, std::size_t i) const {
  constexpr double kLeastDistance = 1e-30;
  const ParaboloidPair& pair = map_->pair();
  const glm::dvec3 place = pair.to_eye({s.x_ws[i], s.y_ws[i], s.z_ws[i]});
  const double distance = std::max(glm::length(place), kLeastDistance);
  const glm::dvec3 way = place / distance;
  Receiver r;
  r.map = ParaboloidPair::map_of(way);
  r.texel = pair.texel_of(way, r.map);
  r.reverse = 1 / distance;
  r.id = s.id[i];
  const glm::dvec3 normal = pair.to_local({s.normal_x_ws[i], s.normal_y_ws[i], s.normal_z_ws[i]});
  const double height = glm::dot(normal, place);
  // Along its plane a ray meets the sample's surface nowhere else: there is only the sample itself to be compared.
  const bool is_edge_on = std::abs(height) < kRounding * distance;
  r.plane = is_edge_on ? way * r.reverse : normal / height;
  r.footprint = pair.texel_angle(way) * r.reverse;
  const auto change = [&](const glm::dvec2& step) {
    const glm::dvec3 across =
        pair.direction_of(r.texel + step, r.map) - pair.direction_of(r.texel - step, r.map);
    return std::abs(glm::dot(r.plane, across));
  };
  r.change = change({0.5, 0}) + change({0, 0.5});
  r.rounding = kRounding * r.reverse + 4 * s.position_error * r.reverse * r.reverse;
  return r;
}

ParaboloidShadow::Tap ParaboloidShadow::tap(const Receiver& r, int x, int y) const {
  const ParaboloidMap::Texel& texel = map_->at(r.map, x, y);
  double on_plane = r.reverse;
  if (bias_.uses_receiver_plane)
    on_plane = glm::dot(r.plane, map_->pair().direction_of({x + 0.5, y + 0.5}, r.map));
  return {texel.reverse_distance, on_plane, texel.id};
}

// ---------------------------------------------------------------------------------------------- plain filters

double ParaboloidShadow::compare(const Receiver& r, const Tap& tap) const {
  const double bias = r.rounding + static_cast<double>(bias_.texels) * r.footprint +
                      static_cast<double>(bias_.slope) * r.change +
                      static_cast<double>(bias_.metres) * r.reverse * r.reverse;
  // Beyond its horizon the receiver's plane is nowhere.
  if (tap.id == kNoTriangle || tap.stored <= tap.on_plane + bias) return 1;
  if (soft_edge_ <= 0) return 0;
  const double before = tap.on_plane > 0 ? 1 / tap.on_plane - 1 / tap.stored : soft_edge_;
  return 1 - smooth_step(std::clamp(before / soft_edge_, 0.0, 1.0));
}

// Percentage-closer filtering: Reeves, Salesin and Cook 1987.
double ParaboloidShadow::filtered(const Receiver& r) const {
  if (filter_ == ShadowFilter::bilinear) {
    const double x = std::floor(r.texel.x - 0.5), y = std::floor(r.texel.y - 0.5);
    const double right = r.texel.x - 0.5 - x, low = r.texel.y - 0.5 - y;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const auto at = [&](int i, int j) { return compare(r, tap(r, column + i, row + j)); };
    return (at(0, 0) * (1 - right) + at(1, 0) * right) * (1 - low) +
           (at(0, 1) * (1 - right) + at(1, 1) * right) * low;
  }
  const int count = filter_ == ShadowFilter::nearest ? 1 : kernel_;
  const int column = static_cast<int>(std::floor(r.texel.x - 0.5 * (count - 1)));
  const int row = static_cast<int>(std::floor(r.texel.y - 0.5 * (count - 1)));
  double sum = 0;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) sum += compare(r, tap(r, column + i, row + j));
  }
  return sum / (count * count);
}

// ---------------------------------------------------------------------------------------------- refined

// False: the four texels agree by a margin, and `alpha` is the answer.
bool ParaboloidShadow::find_suspects(const Receiver& r, Suspects& suspects, double& alpha) const {
  const double near = r.rounding + kNearTexels * r.footprint + kNearSlopes * r.change;
  const double beyond = r.rounding + kBeyondTexels * r.footprint;
  const double left = std::floor(r.texel.x - 0.5), top = std::floor(r.texel.y - 0.5);
  const double right_weight = r.texel.x - 0.5 - left, low_weight = r.texel.y - 0.5 - top;
  int far_count = 0;
  for (int k = 0; k < 4; ++k) {
    const int x = k & 1, y = k >> 1;
    const Tap seen = tap(r, static_cast<int>(left) + x, static_cast<int>(top) + y);
    if (seen.id == kNoTriangle || seen.id == r.id) continue;
    // On a slope the plane may pass the texel's centre nearer to the light than what stands before the sample itself.
    const bool is_before_sample = seen.stored > r.reverse + r.rounding;
    const bool shades_sample = is_before_sample && seen.stored + beyond < seen.on_plane;
    if (seen.stored <= seen.on_plane + r.rounding && !shades_sample) continue;
    const std::size_t suspect = suspects.add(seen.id);
    if (!(seen.stored > seen.on_plane + near && seen.stored > r.reverse + near)) continue;
    ++far_count;
    suspects.far_weight[suspect] +=
        (x == 0 ? 1 - right_weight : right_weight) * (y == 0 ? 1 - low_weight : low_weight);
  }
  alpha = suspects.count == 0 ? 1 : 0;
  return suspects.count > 0 && far_count < 4;
}

// Triangles in question are tested at the pixel's centre and about it. The centre has the deciding vote: α ≥ 1/2 is the
// hard shadow there.
double ParaboloidShadow::refined(const SurfaceSamples& s, std::size_t i) const {
  Suspects suspects;
  double alpha = 0;
  const Receiver receiver = find_receiver(s, i);
  if (!find_suspects(receiver, suspects, alpha)) return alpha;
  const float nearest = nearest_blocker(s, i);
  const glm::vec3 centre(s.x_ws[i], s.y_ws[i], s.z_ws[i]);
  bool is_dark = is_blocked(centre, nearest, suspects);
  double unsure = 0;  // weight of texels that saw, far in front, what is too small to be sure of
  if (!is_dark) {
    const glm::dvec3 place = map_->pair().to_eye(glm::dvec3(centre));
    const std::size_t seen = suspects.count;
    for (std::size_t k = 0; k < seen; ++k) {
      const bool is_settled = walk_on(suspects.id[k], receiver.id, place, suspects);
      if (!is_settled && is_small(suspects.id[k])) unsure += suspects.far_weight[k];
    }
    is_dark = suspects.count > seen && is_blocked(centre, nearest, suspects);
  }
  double lit = is_dark ? 0 : 1 - unsure;
  const bool is_lit = lit >= 0.5;
  for (int k = 1; k < positions_; ++k) {
    const glm::dvec3 step = step_on_plane(s, i, kPlaces[k]);
    // Beyond the end of its triangle the plane may run into the next one; that must not darken what is lit.
    const float beside = is_lit ? static_cast<float>(2 * glm::length(step)) : 0.0F;
    const glm::vec3 place(glm::dvec3(centre) + step);
    lit += is_blocked(place, nearest + beside, suspects) ? 0 : 1 - unsure;
  }
  if (positions_ == 1) return lit;
  lit /= positions_;
  return is_lit ? std::max(lit, 0.6) : std::min(lit, 0.4);
}

// From a triangle that the way from the light to `place` misses, over the surface to where it passes: always across the
// edge beyond which that is. Adds what it comes by; true where the surface ends or the way is met.
bool ParaboloidShadow::walk_on(TriangleId start, TriangleId own, const glm::dvec3& place,
                               Suspects& suspects) const {
  if (neighbours_ == nullptr) return false;
  TriangleId id = start, from = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const LocalTriangle t(frame_, id, map_->pair());
    const double sign = t.volume() < 0 ? -1 : 1;
    const auto weight = [&](std::size_t a, std::size_t b) {
      return sign * glm::dot(place, glm::cross(t.corner[a], t.corner[b]));
    };
    // Of the corners opposite to the edges.
    const std::array<double, 3> weights = {weight(0, 1), weight(1, 2), weight(2, 0)};
    if (!(weights[0] + weights[1] + weights[2] > 0)) return false;
    const std::array<TriangleId, 3> across = find_across(id);
    double lowest = 0;
    TriangleId next = id;
    bool is_open = false;
    for (std::size_t k = 0; k < 3; ++k) {
      is_open = is_open || (weights[k] < 0 && across[k] == id);
      // Where the surface folds back, the way on is the way back.
      if (across[k] == id || across[k] == from || weights[k] >= lowest) continue;
      lowest = weights[k];
      next = across[k];
    }
    if (next == id) return !is_open;
    if (next == own) return true;
    from = id;
    id = next;
    suspects.add(id);
  }
  return false;
}

// Beyond the edge from each corner to the next; the triangle itself where there is nothing.
std::array<TriangleId, 3> ParaboloidShadow::find_across(TriangleId id) const {
  const std::int32_t source = neighbours_->sources[cluster_of(id)];
  const std::size_t in_mesh =
      (static_cast<std::size_t>(source >> 1) << kTriangleBits) + (id & (kTrianglesPerCluster - 1));
  const glm::ivec3& steps = neighbours_->meshes->steps[in_mesh];
  const auto across = [&](int k) {
    return static_cast<TriangleId>(static_cast<std::int32_t>(id) + steps[k]);
  };
  // A mirrored instance has its second and third corners swapped.
  const bool is_mirrored = (source & 1) != 0;
  return {across(is_mirrored ? 2 : 0), across(1), across(is_mirrored ? 0 : 2)};
}

bool ParaboloidShadow::is_blocked(const glm::vec3& position_ws, float nearest,
                                  const Suspects& suspects) const {
  return std::any_of(suspects.id.begin(), suspects.id.begin() + static_cast<std::ptrdiff_t>(suspects.count),
                     [&](TriangleId id) { return darkens(frame_, light_, position_ws, nearest, id); });
}

// By the solid angle of a triangle that is small.
bool ParaboloidShadow::is_small(TriangleId id) const {
  const LocalTriangle t(frame_, id, map_->pair());
  const glm::dvec3 middle = (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0;
  const double distance = glm::length(middle);
  if (distance == 0) return false;
  const double texel = map_->pair().texel_angle(middle / distance);
  return std::abs(t.volume()) < 2 * kSmallTexels * texel * texel * distance * distance * distance;
}

}  // namespace laterna::shadow
