#include "bake/light_map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "bake/atlas_packer.h"
#include "bake/charts.h"
#include "bake/laid_out_surfaces.h"
#include "bake/own_meshes.h"
#include "bake/primitive_corners.h"
#include "base/refuse.h"
#include "laterna/material_lobes.h"
#include "laterna/relief.h"
#include "scene/surface_attributes.h"

namespace laterna::bake {
namespace {

// Squares per luxel's side in which charts are looked at for overlap.
constexpr double kOverlapSquares = 2;

// What is packed as one: a chart of a primitive, or all that shares a file's own second texture coordinates.
struct Piece {
  std::vector<SurfaceOfMesh> surfaces;
  glm::ivec2 luxels{1};
  Chart chart;              // empty: the unit square of the file's own coordinates
  glm::dvec2 from_flat{1};  // luxels per unit of the chart's plane
  bool is_double_sided = false;
};

std::vector<glm::dvec3> corners_of(const Primitive& primitive, const glm::dmat4& world_from_mesh) {
  std::vector<glm::dvec3> corners;
  for (std::size_t corner = 0; corner < corner_count(primitive); ++corner) {
    const glm::dvec3 position(primitive.positions[vertex_of(primitive, corner)]);
    corners.emplace_back(world_from_mesh * glm::dvec4(position, 1));
  }
  return corners;
}

double area_of(std::span<const glm::dvec3> corners) {
  double sum = 0;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const glm::dvec3 n = glm::cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t]);
    sum += std::sqrt(glm::dot(n, n)) / 2;
  }
  return sum;
}

double area_of(std::span<const glm::dvec2> corners) {
  double sum = 0;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const glm::dvec2 u = corners[t + 1] - corners[t], v = corners[t + 2] - corners[t];
    sum += std::abs(u.x * v.y - u.y * v.x) / 2;
  }
  return sum;
}

bool uses(const Material& material, int uv_set) {
  const auto does = [uv_set](const Texture& texture) { return texture.is_set() && texture.uv_set == uv_set; };
  return std::ranges::any_of(textures_of(material), [&](auto t) { return does(*t); }) ||
         (material.relief != nullptr && does(material.relief->texture));
}

class Layout {
 public:
  Layout(Scene& scene, const BakeSettings& settings) : scene_(scene), settings_(settings), surfaces_(scene) {}

  Result<LightMapLayout> make() {
    for (const PlacedMesh& placed : take_apart(scene_)) {
      if (Result<void> added = add_mesh(placed); !added) return tl::unexpected(std::move(added.error()));
    }
    layout_.charts = pieces_.size();
    if (Result<void> packed = pack(); !packed) return tl::unexpected(std::move(packed.error()));
    layout_.page_of_material = surfaces_.make();
    return std::move(layout_);
  }

 private:
  void warn(const std::string& object, std::string message) {
    scene_.warnings.push_back({{}, fmt::format("object \"{}\"", object), std::move(message)});
  }
  [[nodiscard]] Primitive& at(const SurfaceOfMesh& s) {
    return scene_.meshes[s.mesh].primitives[s.primitive];
  }
  [[nodiscard]] const Material& material_of(const Primitive& primitive) const {
    static const Material usual;
    return primitive.material < 0 ? usual : scene_.materials[static_cast<std::size_t>(primitive.material)];
  }

  // -------------------------------------------------------------------------------------------- pieces

  Result<void> add_mesh(const PlacedMesh& placed) {
    std::vector<SurfaceOfMesh> surfaces;
    bool has_shared = false;
    for (std::size_t i = 0; i < scene_.meshes[placed.mesh].primitives.size(); ++i) {
      Primitive& primitive = scene_.meshes[placed.mesh].primitives[i];
      const Material& material = material_of(primitive);
      if (corner_count(primitive) == 0 || !can_have_light_map(material)) continue;
      surfaces.push_back({placed.mesh, i});
      if (!uses(material, 1)) continue;
      const bool is_shared = uses(material, 0);
      has_shared = has_shared || is_shared;
      surfaces_.set_use(surfaces.back(), is_shared ? SecondCoordinates::shared : SecondCoordinates::moved);
      if (!is_shared) primitive.uv[0] = primitive.uv[1];
    }
    layout_.surfaces += surfaces.size();
    if ((has_shared || !settings_.unwrap_all) && add_own_coordinates(placed, surfaces)) return {};
    for (const SurfaceOfMesh& surface : surfaces) {
      const Material& material = material_of(at(surface));
      if (uses(material, 1) && uses(material, 0)) {
        warn(
            placed.name,
            "its textures use both sets of texture coordinates, of which the second does not serve for light "
            "maps: it is not baked");
        --layout_.surfaces;
      } else if (Result<void> added = add_charts(placed, surface); !added) {
        return added;
      }
    }
    return {};
  }

  // Whether the second texture coordinates that a mesh has serve as they are.
  bool add_own_coordinates(const PlacedMesh& placed, const std::vector<SurfaceOfMesh>& surfaces) {
    if (surfaces.empty()) return false;
    std::vector<glm::dvec2> flat;
    double area = 0;
    Piece piece;
    for (const SurfaceOfMesh& surface : surfaces) {
      const Primitive& primitive = at(surface);
      if (primitive.uv[1].empty()) return false;
      for (std::size_t corner = 0; corner < corner_count(primitive); ++corner)
        flat.emplace_back(primitive.uv[1][vertex_of(primitive, corner)]);
      area += area_of(corners_of(primitive, placed.world_from_mesh));
      piece.is_double_sided = piece.is_double_sided || material_of(primitive).double_sided;
    }
    const bool is_within = std::ranges::all_of(
        flat, [](const glm::dvec2& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; });
    const double flat_area = area_of(flat);
    if (!(flat_area > 0) || !is_within) {
      warn(placed.name,
           "its second texture coordinates leave the unit square or span no area: laid out anew");
      return false;
    }
    const double side = std::max(1.0, settings_.density * std::sqrt(area / flat_area));
    if (side > settings_.max_size - 2) {
      warn(placed.name, "its second texture coordinates would take more than a page: laid out anew");
      return false;
    }
    if (overlap(flat, 1 / (kOverlapSquares * side))) {
      warn(placed.name, "its second texture coordinates overlap: laid out anew");
      return false;
    }
    piece.surfaces = surfaces;
    piece.from_flat = glm::dvec2(side);
    // Half a luxel beyond each side is read at the rim.
    piece.luxels = glm::ivec2(static_cast<int>(std::ceil(side)) + 2);
    pieces_.push_back(std::move(piece));
    return true;
  }

  Result<void> add_charts(const PlacedMesh& placed, const SurfaceOfMesh& surface) {
    const Primitive& primitive = at(surface);
    const double density = settings_.density;
    // Turned about, a rectangle is at most √2 longer, and seen along another direction at most 1 / cos 30°.
    const double most = (settings_.max_size - 2) / (density * 1.7);
    for (Chart& chart : cut_into_charts(corners_of(primitive, placed.world_from_mesh),
                                        1 / (kOverlapSquares * density), most)) {
      Piece piece;
      piece.surfaces = {surface};
      piece.is_double_sided = material_of(primitive).double_sided;
      for (int axis = 0; axis < 2; ++axis) {
        // The rim lies on the middles of luxels, so that all that is read at it belongs to the chart: a whole number of steps.
        const double wanted = chart.size[axis] * density;
        const double steps = std::max(1.0, std::ceil(wanted - 1e-6));
        if (!(steps < settings_.max_size))
          return refuse(
              fmt::format("object \"{}\": a triangle of {:.6g} m takes more than a light map of {} luxels: "
                          "at most {:.6g} luxels per "
                          "metre fit, asked for were {:.6g}",
                          placed.name, chart.size[axis], settings_.max_size,
                          (settings_.max_size - 1) / chart.size[axis], density));
        piece.from_flat[axis] = wanted >= 1 ? density * steps / wanted : density;
        piece.luxels[axis] = static_cast<int>(steps) + 1;
      }
      piece.chart = std::move(chart);
      pieces_.push_back(std::move(piece));
    }
    return {};
  }

  // -------------------------------------------------------------------------------------------- places

  // Double-sided surfaces have pages of their own: only these need pictures of backs.
  Result<void> pack() {
    std::uint64_t luxels = 0;
    for (const Piece& piece : pieces_)
      luxels += static_cast<std::uint64_t>(piece.luxels.x) * static_cast<std::uint64_t>(piece.luxels.y);
    if (luxels > kMostLuxels) return refuse_luxels(luxels);
    world_from_mesh_ = world_matrices();
    for (const bool is_double_sided : {false, true}) {
      std::vector<std::size_t> chosen;
      std::vector<glm::ivec2> sizes;
      for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (pieces_[i].is_double_sided != is_double_sided) continue;
        chosen.push_back(i);
        sizes.push_back(pieces_[i].luxels);
      }
      if (sizes.empty()) continue;
      const std::size_t first = layout_.pages.size();
      const std::optional<PackedRectangles> packed =
          pack_rectangles(sizes, settings_.padding, settings_.max_size, kMostLightMaps - first);
      if (!packed)
        return refuse(
            fmt::format("max_size: the light maps would be more than {} of {} luxels a side: ask for larger "
                        "ones, or for a lower density",
                        kMostLightMaps, settings_.max_size));
      for (const glm::ivec2& size : packed->pages) layout_.pages.push_back({size, is_double_sided});
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        set_coordinates(pieces_[chosen[i]], first + packed->places[i].page, packed->places[i].corner);
        pieces_[chosen[i]].chart = {};
      }
    }
    std::uint64_t total = 0;
    for (const LightMapPage& page : layout_.pages)
      total += static_cast<std::uint64_t>(page.size.x) * static_cast<std::uint64_t>(page.size.y);
    if (total > kMostLuxels) return refuse_luxels(total);
    layout_.used = total == 0 ? 0 : used_luxels_ / static_cast<double>(total);
    return {};
  }

  static tl::unexpected<Error> refuse_luxels(std::uint64_t luxels) {
    return refuse(fmt::format("the light maps would hold {} luxels, more than {}: bake at a lower density",
                              luxels, kMostLuxels));
  }

  [[nodiscard]] std::vector<glm::dmat4> world_matrices() const {
    const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene_);
    std::vector<glm::dmat4> matrices(scene_.meshes.size(), glm::dmat4(1));
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      if (scene_.nodes[i].mesh >= 0)
        matrices[static_cast<std::size_t>(scene_.nodes[i].mesh)] = world_from_node[i];
    }
    return matrices;
  }

  void set_coordinates(const Piece& piece, std::size_t page, const glm::ivec2& corner) {
    const glm::dvec2 size(layout_.pages[page].size);
    surfaces_.begin_piece({piece.from_flat / size, (glm::dvec2(corner) + 1.0) / size});
    for (const SurfaceOfMesh& surface : piece.surfaces) {
      const Primitive& primitive = at(surface);
      const glm::dmat4& world_from_mesh = world_from_mesh_[surface.mesh];
      const auto place_of = [&](const glm::dvec3& point, std::size_t c) {
        const glm::dvec2 luxel =
            piece.chart.triangles.empty()
                ? glm::dvec2(primitive.uv[1][vertex_of(primitive, c)]) * piece.from_flat + 1.0
                : (piece.chart.flat(point) - piece.chart.low) * piece.from_flat + 0.5;
        return glm::vec2((luxel + glm::dvec2(corner)) / size);
      };
      const auto set_triangle = [&](std::uint32_t t) {
        std::array<glm::dvec3, 3> points;
        std::array<glm::vec2, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t c = 3 * std::size_t{t} + k;
          const glm::dvec3 position(primitive.positions[vertex_of(primitive, c)]);
          points[k] = glm::dvec3(world_from_mesh * glm::dvec4(position, 1));
          places[k] = place_of(points[k], c);
        }
        surfaces_.add(surface, page, t, places);
        measure(points, places, size);
      };
      if (piece.chart.triangles.empty()) {
        for (std::uint32_t t = 0; t < corner_count(primitive) / 3; ++t) set_triangle(t);
      } else {
        for (const std::uint32_t t : piece.chart.triangles) set_triangle(t);
      }
    }
  }

  // By its least height: places are single precision, 1e-4 of a luxel on a large page.
  [[nodiscard]] bool is_thin(const glm::dvec3& u, const glm::dvec3& v) const {
    constexpr double kThin = 0.01;
    const glm::dvec3 n = glm::cross(u, v), w = v - u;
    const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
    const double side = kThin / settings_.density;
    return !(glm::dot(n, n) > side * side * longest);
  }

  // Luxels per metre are the singular values of the map from a triangle's plane to the page.
  void measure(const std::array<glm::dvec3, 3>& p, const std::array<glm::vec2, 3>& places,
               const glm::dvec2& size) {
    std::array<glm::dvec2, 3> q;
    for (std::size_t k = 0; k < 3; ++k) q[k] = glm::dvec2(places[k]) * size;
    const glm::dvec2 qu = q[1] - q[0], qv = q[2] - q[0];
    used_luxels_ += std::abs(qu.x * qv.y - qu.y * qv.x) / 2;
    const glm::dvec3 u = p[1] - p[0], v = p[2] - p[0];
    const double uu = glm::dot(u, u);
    if (is_thin(u, v)) {
      ++layout_.thin_triangles;
      return;
    }
    // In axes along u and square to it, u = (a, 0) and v = (b, c).
    const double a = std::sqrt(uu), b = glm::dot(u, v) / a;
    const double c = std::sqrt(std::max(glm::dot(v, v) - b * b, 0.0));
    const glm::dvec2 x = qu / a, y = (qv - x * b) / c;
    const double half = (glm::dot(x, x) + glm::dot(y, y)) / 2;
    const double other = (glm::dot(x, x) - glm::dot(y, y)) / 2, mixed = glm::dot(x, y);
    const double spread = std::sqrt(other * other + mixed * mixed);
    const double least = std::sqrt(std::max(half - spread, 0.0)), greatest = std::sqrt(half + spread);
    layout_.least_density = layout_.greatest_density == 0 ? least : std::min(layout_.least_density, least);
    layout_.greatest_density = std::max(layout_.greatest_density, greatest);
  }

  Scene& scene_;
  const BakeSettings& settings_;
  LightMapLayout layout_;
  LaidOutSurfaces surfaces_;
  std::vector<Piece> pieces_;
  double used_luxels_ = 0;
  std::vector<glm::dmat4> world_from_mesh_;  // by mesh
};

}  // namespace

bool can_have_light_map(const Material& material) {
  return !material.unlit && (material.lobes == nullptr || material.lobes->transmission.factor <= 0);
}

Result<LightMapLayout> lay_out(Scene& scene, const BakeSettings& settings) {
  return Layout(scene, settings).make();
}

}  // namespace laterna::bake
