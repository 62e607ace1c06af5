// Surfaces whose triangles have their places in light maps, made into primitives and materials.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "laterna/scene.h"

namespace laterna::bake {

struct SurfaceOfMesh {
  std::size_t mesh, primitive;
  auto operator<=>(const SurfaceOfMesh&) const = default;
};

/// What becomes of a material's textures when the second texture coordinates are needed for light maps.
enum class SecondCoordinates : std::uint8_t {
  unused,  ///< by its textures
  /// All its textures use them, and the first are free: they become the first.
  moved,
  /// Textures use both. The second serve for light maps as they are, but for where in the page they lie: the textures that
  /// use them undo this.
  shared,
};

/// Where the square of texture coordinates lies in a page: page = from_mesh · scale + offset, of the page's 0 … 1.
struct PlaceInPage {
  glm::dvec2 scale{1}, offset{0};
};

/// Collects places chart by chart, then makes of every primitive one for each page that it has a part of, and of every material
/// one for each page. The memory is that of the triangles, however many pages there are.
class LaidOutSurfaces {
 public:
  explicit LaidOutSurfaces(Scene& scene) : scene_(scene) {}

  void set_use(const SurfaceOfMesh& surface, SecondCoordinates use) { use_[surface] = use; }
  /// Begins what is laid out as one: vertices are shared within it alone.
  void begin_piece(const PlaceInPage& place) { places_.push_back(place); }
  /// Of the piece begun last: corners in the page's 0 … 1.
  void add(const SurfaceOfMesh& surface, std::size_t page, std::uint32_t triangle,
           const std::array<glm::vec2, 3>& corners);

  /// Changes the scene. The page of each of its materials; −1: none. What was collected is used up.
  std::vector<int> make();

 private:
  struct PlacedTriangle {
    std::uint32_t triangle, piece;
    std::array<glm::vec2, 3> corners;
  };
  using Triangles = std::vector<PlacedTriangle>;
  /// Page, and the piece whose place its textures undo; primitives that differ need other materials.
  struct Kind {
    std::size_t page = 0;
    SecondCoordinates use = SecondCoordinates::unused;
    std::uint32_t piece = 0;  // 0 unless shared
    auto operator<=>(const Kind&) const = default;
  };

  void make_primitives();
  void make_materials();
  static Primitive with_places(const Primitive& from, const Triangles& triangles);
  [[nodiscard]] Primitive& at(const SurfaceOfMesh& surface) {
    return scene_.meshes[surface.mesh].primitives[surface.primitive];
  }

  Scene& scene_;
  std::map<SurfaceOfMesh, SecondCoordinates> use_;
  std::vector<PlaceInPage> places_;  // of each piece; pieces count from 1
  std::map<std::pair<SurfaceOfMesh, std::size_t>, Triangles> triangles_;  // by surface and page
  std::map<SurfaceOfMesh, Kind> kinds_;                                   // of the primitives as made
  std::vector<int> page_of_material_;
};

}  // namespace laterna::bake
