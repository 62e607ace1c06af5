#include "light/mirror_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace laterna::light {
namespace {

glm::dvec3 corner_of(const frame::Frame& frame, TriangleId id, unsigned corner) {
  return glm::dvec3(frame.corner_ws(id, corner));
}

template <class Use>  // Use: the three corners
void for_each_triangle(const frame::Frame& frame, const FlatMirror& mirror, Use use) {
  for (const std::uint32_t cluster : mirror.clusters) {
    for (std::uint32_t t = 0; t < frame.clusters[cluster].triangle_count; ++t) {
      const TriangleId id = cluster << kTriangleBits | t;
      use(std::array<glm::dvec3, 3>{corner_of(frame, id, 0), corner_of(frame, id, 1),
                                    corner_of(frame, id, 2)});
    }
  }
}

glm::dvec3 doubled_area(const std::array<glm::dvec3, 3>& corners) {
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

// The mean of its triangles' planes, each by its area. Sheets whose two sides are both drawn may be wound either way: all are
// turned like the largest.
void fit_plane(const frame::Frame& frame, FlatMirror& mirror) {
  glm::dvec3 largest(0);
  for_each_triangle(frame, mirror, [&](const auto& corners) {
    const glm::dvec3 area = doubled_area(corners);
    if (glm::dot(area, area) > glm::dot(largest, largest)) largest = area;
  });
  glm::dvec3 normal(0), moment(0);
  double areas = 0;
  for_each_triangle(frame, mirror, [&](const auto& corners) {
    const glm::dvec3 area = doubled_area(corners);
    normal += glm::dot(area, largest) < 0 ? -area : area;
    moment += glm::length(area) * (corners[0] + corners[1] + corners[2]) / 3.0;
    areas += glm::length(area);
  });
  if (glm::length(normal) == 0) return;
  mirror.normal_ws = normal / glm::length(normal);
  mirror.offset = glm::dot(mirror.normal_ws, moment / areas);
}

// Finds how far corners lie off the plane, and says what is wrong with that.
std::string check_plane(const frame::Frame& frame, FlatMirror& mirror) {
  glm::dvec3 low(1e300), high(-1e300);
  double farthest = 0;
  for_each_triangle(frame, mirror, [&](const auto& corners) {
    for (const glm::dvec3& corner : corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
      farthest = std::max(farthest, std::abs(glm::dot(mirror.normal_ws, corner) - mirror.offset));
    }
  });
  if (glm::length(mirror.normal_ws) == 0) return "has no area";
  const glm::dvec3 sides = high - low, reach = glm::max(glm::abs(low), glm::abs(high));
  const double longest = std::max({sides.x, sides.y, sides.z});
  // Rounding of its corners to single precision.
  mirror.deviation = 2 * farthest + 1e-6 * std::max({reach.x, reach.y, reach.z});
  if (farthest <= kMirrorFlatness * longest) return {};
  return fmt::format(
      "is not flat: it leaves its plane by {:.3g} m, and is {:.3g} m long; a mirror may by {:.3g}", farthest,
      longest, kMirrorFlatness * longest);
}

Diagnostic fault_of(const frame::Frame& frame, const FlatMirror& mirror, const std::string& message) {
  return {mirror.mirror->file, mirror.mirror->place,
          fmt::format("the mirror of object \"{}\" {}", frame.object_names[mirror.object], message)};
}

// The part of a convex polygon where `side` is not negative: Sutherland and Hodgman 1974.
template <class Side>
std::vector<glm::dvec3> clip(const std::vector<glm::dvec3>& polygon, Side side) {
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = side(a), at_b = side(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return kept;
}

// A view into mirrors, and what it sees of the picture.
struct Looking {
  View view;
  PixelBox box;
  const MirrorView* through = nullptr;  // null: nothing lies between
};

class MirrorPlanning {
 public:
  MirrorPlanning(const frame::Frame& frame, int width, int height)
      : frame_(frame), width_(width), height_(height) {}

  // What `from` sees in the mirror; an empty box: nothing.
  [[nodiscard]] MirrorView look_into(const FlatMirror& mirror, const Looking& from) const {
    MirrorView seen;
    const View& view = from.view;
    const bool is_orthographic = view.projection.is_orthographic;
    const double before = is_orthographic ? -glm::dot(mirror.normal_ws, view.pose.forward_ws())
                                          : glm::dot(mirror.normal_ws, view.pose.position_ws) - mirror.offset;
    if (before == 0 || (before < 0 && !mirror.double_sided)) return seen;
    const double sign = before < 0 ? -1 : 1;
    seen.normal_ws = sign * mirror.normal_ws;
    seen.offset = sign * mirror.offset;
    seen.tolerance = mirror.deviation;
    seen.box = mirrored(pixels_of(mirror, from), width_);
    seen.view = mirrored(view, mirror.normal_ws, mirror.offset);
    return seen;
  }

 private:
  // Those that it may cover, with some about them where what it shows is displaced.
  [[nodiscard]] PixelBox pixels_of(const FlatMirror& mirror, const Looking& from) const {
    const Pose& pose = from.view.pose;
    const double near = from.view.projection.near;
    const glm::dmat4 image_from_world = from.view.image_from_world();
    glm::dvec2 low(1e300), high(-1e300);
    for_each_triangle(frame_, mirror, [&](const auto& corners) {
      std::vector<glm::dvec3> part(corners.begin(), corners.end());
      part = clip(part, [&](const glm::dvec3& p) {
        return glm::dot(pose.forward_ws(), p - pose.position_ws) - near;
      });
      if (from.through != nullptr) {
        const MirrorView& t = *from.through;
        part = clip(part,
                    [&](const glm::dvec3& p) { return glm::dot(t.normal_ws, p) - t.offset - t.tolerance; });
      }
      for (const glm::dvec3& p : part) {
        const glm::dvec4 image = image_from_world * glm::dvec4(p, 1);
        const glm::dvec2 pixel(image.x / image.w * width_, image.y / image.w * height_);
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
      }
    });
    if (low.x > high.x) return {};
    const bool is_displaced = mirror.mirror->roughness > 0 || !mirror.mirror->waves.empty();
    const int reach = is_displaced ? std::max(width_, height_) / 6 : 0;
    // Clamped first: far off the picture numbers need not be whole ones that fit.
    const auto first = [&](double at, int begin) {
      return std::max(begin, static_cast<int>(std::floor(std::clamp(at, -1e6, 1e6))) - 1);
    };
    const auto end = [&](double at, int last) {
      return std::min(last, static_cast<int>(std::ceil(std::clamp(at, -1e6, 1e6))) + 1);
    };
    PixelBox box = {first(low.x, from.box.x_begin), first(low.y, from.box.y_begin),
                    end(high.x, from.box.x_end), end(high.y, from.box.y_end)};
    if (box.is_empty()) return {};
    return {std::max(box.x_begin - reach, 0), std::max(box.y_begin - reach, 0),
            std::min(box.x_end + reach, width_), std::min(box.y_end + reach, height_)};
  }

  const frame::Frame& frame_;
  int width_, height_;
};

}  // namespace

Result<std::vector<FlatMirror>> find_mirrors(const frame::Frame& frame) {
  std::vector<FlatMirror> mirrors;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;  // by object and surface
  for (std::uint32_t i = 0; i < frame.clusters.size(); ++i) {
    const Cluster& cluster = frame.clusters[i];
    const frame::Surface& surface = frame.surfaces[cluster.material];
    if (surface.mirror == nullptr || (cluster.flags & kVisible) == 0) continue;
    const auto [place, is_new] = known.try_emplace({cluster.object, cluster.material}, mirrors.size());
    if (is_new) {
      mirrors.emplace_back();
      mirrors.back().mirror = surface.mirror.get();
      mirrors.back().double_sided = surface.double_sided;
      mirrors.back().surface = cluster.material;
      mirrors.back().object = cluster.object;
    }
    mirrors[place->second].clusters.push_back(i);
  }
  std::vector<Diagnostic> faults;
  for (FlatMirror& mirror : mirrors) {
    fit_plane(frame, mirror);
    const std::string fault = check_plane(frame, mirror);
    if (!fault.empty()) faults.push_back(fault_of(frame, mirror, fault));
  }
  if (!faults.empty()) return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  return mirrors;
}

View mirrored(const View& view, const glm::dvec3& normal_ws, double offset) {
  const auto reflect = [&](const glm::dvec3& v) { return v - 2 * glm::dot(normal_ws, v) * normal_ws; };
  const glm::dmat3& axes = view.pose.world_from_view_rotation;
  View image = view;
  image.pose.position_ws = reflect(view.pose.position_ws) + 2 * offset * normal_ws;
  // A reflected frame is left-handed. With its right turned round it is a pose, and the frustum's sides change places.
  image.pose.world_from_view_rotation = glm::dmat3(-reflect(axes[0]), reflect(axes[1]), reflect(axes[2]));
  image.projection.left = -view.projection.right;
  image.projection.right = -view.projection.left;
  return image;
}

Result<MirrorPlan> make_mirror_plan(const frame::Frame& frame, const View& view, int width, int height,
                                    int depth) {
  Result<std::vector<FlatMirror>> mirrors = find_mirrors(frame);
  if (!mirrors) return tl::unexpected(std::move(mirrors.error()));
  MirrorPlan plan;
  plan.mirrors = std::move(*mirrors);
  const MirrorPlanning planning(frame, width, height);
  // Breadth first, so that where there are too many the deepest are left out.
  for (int parent = -1; parent < static_cast<int>(plan.views.size()); ++parent) {
    const MirrorView through = parent < 0 ? MirrorView() : plan.views[static_cast<std::size_t>(parent)];
    const int reached = parent < 0 ? 0 : through.depth;
    if (reached >= depth) break;
    const Looking from = parent < 0 ? Looking{view, {0, 0, width, height}, nullptr}
                                    : Looking{through.view, through.box, &through};
    for (std::size_t m = 0; m < plan.mirrors.size() && plan.views.size() < kMaxMirrorPictures; ++m) {
      if (parent >= 0 && through.mirror == static_cast<int>(m)) continue;
      MirrorView seen = planning.look_into(plan.mirrors[m], from);
      if (seen.box.is_empty()) continue;
      seen.mirror = static_cast<int>(m);
      seen.parent = parent;
      seen.depth = reached + 1;
      plan.views.push_back(seen);
    }
  }
  return plan;
}

}  // namespace laterna::light
