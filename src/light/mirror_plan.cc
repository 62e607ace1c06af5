#include "light/mirror_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "light/refracted_view.h"

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
  glm::dvec3 low(1e300), high(-1e300), worst(0);
  double farthest = 0;
  for_each_triangle(frame, mirror, [&](const auto& corners) {
    for (const glm::dvec3& corner : corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
      const double off = std::abs(glm::dot(mirror.normal_ws, corner) - mirror.offset);
      if (off > farthest) worst = corner;
      farthest = std::max(farthest, off);
    }
  });
  if (glm::length(mirror.normal_ws) == 0) return "has no area, and so no plane";
  const glm::dvec3 sides = high - low, reach = glm::max(glm::abs(low), glm::abs(high));
  const double longest = std::max({sides.x, sides.y, sides.z});
  // Rounding of its corners to single precision.
  mirror.deviation = 2 * farthest + 1e-6 * std::max({reach.x, reach.y, reach.z});
  if (farthest <= kMirrorFlatness * longest) return {};
  return fmt::format(
      "is not flat: at ({:.4g}, {:.4g}, {:.4g}) it leaves its plane by {:.3g} m, and is {:.3g} m long, so "
      "that "
      "{:.3g} m is the most; let its flat parts have a material each, and curved ones mirror the environment",
      worst.x, worst.y, worst.z, farthest, longest, kMirrorFlatness * longest);
}

// What is wrong with the objects that one Mirror belongs to is said of the first, with how many more there are.
class MirrorFaults {
 public:
  explicit MirrorFaults(const frame::Frame& frame) : frame_(frame) {}

  void add(const FlatMirror& mirror, const std::string& message) {
    Fault& fault = faults_[mirror.mirror];
    if (++fault.objects > 1) return;
    order_.push_back(mirror.mirror);
    fault.object = mirror.object;
    fault.message = message;
  }
  [[nodiscard]] std::vector<Diagnostic> list() const {
    std::vector<Diagnostic> all;
    for (const Mirror* mirror : order_) {
      const Fault& fault = faults_.at(mirror);
      const std::string more =
          fault.objects == 1 ? "" : fmt::format("; {} more of its objects are no better", fault.objects - 1);
      all.push_back({mirror->file, mirror->place,
                     fmt::format("the mirror of object \"{}\" {}{}", frame_.object_names[fault.object],
                                 fault.message, more)});
    }
    return all;
  }

 private:
  struct Fault {
    std::size_t objects = 0;
    std::uint32_t object = 0;
    std::string message;
  };
  const frame::Frame& frame_;
  std::map<const Mirror*, Fault> faults_;
  std::vector<const Mirror*> order_;
};

// Waves that run straight through every plane that they are on, which would show nothing.
std::vector<Diagnostic> check_waves(const frame::Frame& frame, const std::vector<FlatMirror>& mirrors) {
  constexpr double kLeastWithin = 1e-6;  // of a direction, the sine of its angle to the normal
  std::map<std::pair<const Mirror*, std::size_t>, double> most_within;
  for (const FlatMirror& flat : mirrors) {
    for (std::size_t w = 0; w < flat.mirror->waves.size(); ++w) {
      const glm::dvec3 direction = glm::normalize(flat.mirror->waves[w].direction_ws);
      double& most = most_within.try_emplace({flat.mirror, w}, 0).first->second;
      most = std::max(most, glm::length(glm::cross(direction, flat.normal_ws)));
    }
  }
  std::vector<Diagnostic> faults;
  for (const FlatMirror& flat : mirrors) {
    for (std::size_t w = 0; w < flat.mirror->waves.size(); ++w) {
      const auto entry = most_within.find({flat.mirror, w});
      if (entry == most_within.end() || entry->second > kLeastWithin) continue;
      most_within.erase(entry);  // told once
      const glm::dvec3& n = flat.normal_ws;
      faults.push_back(
          {flat.mirror->file, flat.mirror->place,
           fmt::format("waves[{}].direction runs straight through the surface of object \"{}\", whose normal "
                       "is ({:.3g}, {:.3g}, {:.3g}): give one that lies within it",
                       w, frame.object_names[flat.object], n.x, n.y, n.z)});
    }
  }
  return faults;
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

// Mirrors that lie in one plane do not see one another.
bool lies_in_plane_of(const frame::Frame& frame, const FlatMirror& mirror, const FlatMirror& other) {
  const double along = glm::dot(mirror.normal_ws, other.normal_ws);
  if (std::abs(along) < 0.9) return false;
  bool is_near = true;
  for_each_triangle(frame, mirror, [&](const auto& corners) {
    for (const glm::dvec3& corner : corners) {
      is_near = is_near && std::abs(glm::dot(other.normal_ws, corner) - other.offset) <=
                               mirror.deviation + other.deviation;
    }
  });
  return is_near;
}

void number_planes(const frame::Frame& frame, std::vector<FlatMirror>& mirrors) {
  for (std::size_t m = 0; m < mirrors.size(); ++m) {
    mirrors[m].plane = static_cast<int>(m);
    for (std::size_t k = 0; k < m; ++k) {
      if (mirrors[k].plane != static_cast<int>(k) || !lies_in_plane_of(frame, mirrors[m], mirrors[k]))
        continue;
      mirrors[m].plane = static_cast<int>(k);
      break;
    }
  }
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

  // What `from` sees in the mirror, or through it; an empty box: nothing.
  [[nodiscard]] MirrorView look_into(const FlatMirror& mirror, const Looking& from, bool is_refracted) const {
    MirrorView seen;
    const View& view = from.view;
    const bool is_orthographic = view.projection.is_orthographic;
    const double before = is_orthographic ? -glm::dot(mirror.normal_ws, view.pose.forward_ws())
                                          : glm::dot(mirror.normal_ws, view.pose.position_ws) - mirror.offset;
    if (before == 0 || (before < 0 && !mirror.double_sided)) return seen;
    const double sign = before < 0 ? -1 : 1;
    seen.normal_ws = sign * mirror.normal_ws;
    seen.offset = sign * mirror.offset;
    seen.sees_back = before < 0;
    seen.is_refracted = is_refracted;
    const PixelBox box = pixels_of(mirror, from);
    if (box.is_empty()) return seen;
    if (is_refracted) {
      const SeenOfPlane parts = seen_of(mirror, from);
      if (parts.corners_ws.empty()) return seen;  // beside the picture, by less than the pixels about the box
      const double ior = *mirror.mirror->ior;
      const RefractedView below = refracted_view(
          view, width_, height_, {seen.normal_ws, seen.offset, before < 0 ? 1 / ior : ior}, parts);
      seen.box = below.box;
      seen.view = below.view;
      seen.margin = 2 * below.pixel;
    } else {
      seen.box = mirrored(box, width_);
      seen.view = mirrored(view, mirror.normal_ws, mirror.offset);
    }
    return seen;
  }

 private:
  // Calls `use` with the polygons of the mirror that lie before the view and in the space that it shows.
  template <class Use>
  void for_each_part(const FlatMirror& mirror, const Looking& from, Use use) const {
    const Pose& pose = from.view.pose;
    const double near = from.view.projection.near;
    for_each_triangle(frame_, mirror, [&](const auto& corners) {
      std::vector<glm::dvec3> part(corners.begin(), corners.end());
      part = clip(part, [&](const glm::dvec3& p) {
        return glm::dot(pose.forward_ws(), p - pose.position_ws) - near;
      });
      if (from.through != nullptr) {
        part = clip(part, [&](const glm::dvec3& p) { return from.through->side(p); });
      }
      use(part);
    });
  }

  // The same of what its pixels show.
  [[nodiscard]] SeenOfPlane seen_of(const FlatMirror& mirror, const Looking& from) const {
    const glm::dmat4 image_from_world = from.view.image_from_world();
    const PixelBox& box = from.box;
    SeenOfPlane seen;
    double areas = 0;
    for_each_part(mirror, from, [&](std::vector<glm::dvec3>& part) {
      for (int side = 0; side < 4; ++side) {
        const int axis = side % 2;
        const double sign = side < 2 ? 1 : -1, size = axis == 0 ? width_ : height_;
        const double limit = (side == 0   ? box.x_begin
                              : side == 1 ? box.y_begin
                              : side == 2 ? box.x_end
                                          : box.y_end) /
                             size;
        part = clip(part, [&](const glm::dvec3& p) {
          const glm::dvec4 image = image_from_world * glm::dvec4(p, 1);
          return sign * (image[axis] - limit * image.w);
        });
      }
      std::vector<glm::dvec2> places;
      for (const glm::dvec3& p : part) {
        const glm::dvec4 image = image_from_world * glm::dvec4(p, 1);
        places.emplace_back(image.x / image.w, image.y / image.w);
        seen.corners_ws.push_back(p);
      }
      for (std::size_t i = 2; i < places.size(); ++i) {
        const glm::dvec2 a = places[i - 1] - places[0], b = places[i] - places[0];
        const double area = std::abs(a.x * b.y - a.y * b.x) + 1e-12;
        seen.middle += area * (places[0] + places[i - 1] + places[i]) / 3.0;
        areas += area;
      }
    });
    seen.middle = areas > 0 ? seen.middle / areas : glm::dvec2(0.5);
    return seen;
  }

  // Pixels that it may cover, with some about them where what it shows is displaced.
  [[nodiscard]] PixelBox pixels_of(const FlatMirror& mirror, const Looking& from) const {
    const glm::dmat4 image_from_world = from.view.image_from_world();
    glm::dvec2 low(1e300), high(-1e300);
    for_each_part(mirror, from, [&](const std::vector<glm::dvec3>& part) {
      for (const glm::dvec3& p : part) {
        const glm::dvec4 image = image_from_world * glm::dvec4(p, 1);
        const glm::dvec2 pixel(image.x / image.w * width_, image.y / image.w * height_);
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
      }
    });
    if (low.x > high.x) return {};
    const Mirror& look = *mirror.mirror;
    const bool is_displaced = look.roughness > 0 || !look.waves.empty();
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

// What view number `parent` sees in a mirror and through it, as far as there is room.
void add_looks(const MirrorPlanning& planning, const Looking& from, int parent, int index, MirrorPlan& plan) {
  const FlatMirror& mirror = plan.mirrors[static_cast<std::size_t>(index)];
  const MirrorView through = from.through == nullptr ? MirrorView() : *from.through;
  if (from.through != nullptr && plan.mirrors[static_cast<std::size_t>(through.mirror)].plane == mirror.plane)
    return;
  for (const bool is_refracted : {false, true}) {
    if (is_refracted && !mirror.mirror->volume) continue;
    if (plan.views.size() >= kMaxMirrorPictures) return;
    MirrorView seen = planning.look_into(mirror, from, is_refracted);
    if (seen.box.is_empty()) return;
    seen.mirror = index;
    seen.parent = parent;
    seen.depth = from.through == nullptr ? 1 : through.depth + 1;
    seen.is_turned = through.is_turned != !is_refracted;
    seen.way = through.way;
    seen.way.push_back(2 * index + (is_refracted ? 1 : 0));
    plan.views.push_back(std::move(seen));
  }
}

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
  MirrorFaults faults(frame);
  for (FlatMirror& mirror : mirrors) {
    fit_plane(frame, mirror);
    const std::string fault = check_plane(frame, mirror);
    if (!fault.empty()) faults.add(mirror, fault);
  }
  std::vector<Diagnostic> all = faults.list();
  if (all.empty()) all = check_waves(frame, mirrors);
  if (!all.empty()) return tl::unexpected(Error(Failure::bad_input, std::move(all)));
  number_planes(frame, mirrors);
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
    if (parent >= 0 && through.depth >= depth) break;
    const Looking from = parent < 0 ? Looking{view, {0, 0, width, height}, nullptr}
                                    : Looking{through.view, through.box, &through};
    for (std::size_t m = 0; depth > 0 && m < plan.mirrors.size(); ++m) {
      add_looks(planning, from, parent, static_cast<int>(m), plan);
    }
  }
  return plan;
}

}  // namespace laterna::light
