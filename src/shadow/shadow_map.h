// Shadow maps: Williams, Casting curved shadows on curved surfaces, 1978; filtering by Reeves, Salesin and Cook,
// Rendering antialiased shadows with depth maps, 1987.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "frame/triangle_neighbours.h"
#include "light/light_plan.h"
#include "shadow/depth_map.h"
#include "shadow/projected_view.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

/// How deep a sample may lie behind what the map holds and still be lit.
///
/// The test is made on the receiver's own plane: at the centre of each texel that is read, the plane of the sample's
/// triangle has a depth of its own, and that is what is compared (Schuler 2005, Isidoro 2006). Reversed depth is
/// affine on a plane, so the prediction is exact and a plane never shadows itself, at any slope, with no bias at all.
/// What remains to be paid for are surfaces that bend toward the light within a texel, and rounding.
struct ShadowBias {
  bool uses_receiver_plane = true;
  float texels = 0.5F;  ///< footprint of a texel, as a distance along the ray
  float slope = 0.25F;  ///< change of depth along the plane from one texel to the next
  float metres = 0;
};

/// One depth map bound to the rays of the samples that will ask it. What the kernel reads.
struct BoundDepthMap {
  const DepthMap* map = nullptr;
  ProjectedView position;    // pixel-homogeneous
  ProjectedRow homogeneous;  // the samples' fourth coordinate
  ProjectedRow divisor;      // orthographic: of the three; the fourth coordinate, or that of the warp
  bool is_orthographic = false;
  float eye_ws[3];  // perspective
  float direction_x_ws[3],
      direction_y_ws[3];  // of one texel to the right and down, at distance 1 (perspective) or in metres
  float axis_ws[3];       // orthographic: toward the light
  float texel_size = 0;   // at distance 1, or in metres
  // A warped map's texel steps have a fourth coordinate: how much of a sample's own place is taken from them. Their other
  // three are direction_x_ws and direction_y_ws.
  bool is_warped = false;
  float direction_x_h = 0, direction_y_h = 0;
};

/// Which of a light's maps a sample asks.
enum class MapChoice : std::uint8_t {
  only,  ///< there is one
  face,  ///< six faces of a cube in the order of light::cube_views: the one that the ray from the light passes
  finest  ///< one within the other, the finest first: the first that holds the sample, blended with the next at its rim
};
inline constexpr std::size_t kMostMaps = 8;

/// What one light's look-ups need.
struct ShadowMapTest {
  std::vector<BoundDepthMap> maps;
  MapChoice choice = MapChoice::only;
  ShadowBias bias;
  ShadowFilter filter = ShadowFilter::refined;
  const frame::Frame* frame = nullptr;                    // refined: where the triangles are
  const frame::TriangleNeighbours* neighbours = nullptr;  // and which are side by side; null: not known
  int kernel = 3;
  /// Refined: places in a pixel whose α is averaged at a shadow's edge, 5 or 1.
  int positions = 5;
  float ray_x[4], ray_y[4], q_term[4];  // of the samples' rays
  bool outside_is_lit = true;
  bool is_radial = false;  // plain filters compare distances from the light
  float soft_edge = 0;     // metres; plain filters
  InstructionSet instruction_set = InstructionSet::scalar;
};

/// `maps` must outlive the result; all else that a look-up needs is copied from the planned light's settings.
ShadowMapTest make_shadow_map_test(const light::PlannedLight& planned,
                                   std::span<const std::shared_ptr<DepthMap>> maps, const frame::Frame& frame,
                                   const frame::TriangleNeighbours* neighbours,
                                   const raster::RasterView::Ray& ray, int samples_per_pixel,
                                   InstructionSet set);

class ShadowMap final : public ShadowTechnique {
 public:
  /// `neighbours`: of the frame, or null; both outlive this.
  ShadowMap(const light::PlannedLight& planned, std::span<const std::shared_ptr<DepthMap>> maps,
            const frame::Frame& frame, const frame::TriangleNeighbours* neighbours,
            const raster::RasterView::Ray& ray, int samples_per_pixel, InstructionSet set,
            std::function<bool()> asks_to_stop = nullptr);
  /// Draws the maps' tiles that are needed first. Everything is dark once the caller has asked to stop.
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

 private:
  std::vector<std::shared_ptr<DepthMap>> maps_;
  ShadowMapTest test_;
  std::function<bool()> asks_to_stop_;
};

/// A tile of one of a light's maps.
struct MapTile {
  std::size_t map;
  int x, y;
};
/// Appends the tiles that look-ups for these samples will read and that are not drawn yet; some more than once.
using FindMissingTiles = void (*)(const ShadowMapTest& test, const SurfaceSamples& samples,
                                  std::span<const std::uint16_t> wanted, std::vector<MapTile>& missing);
FindMissingTiles find_missing_tiles_for(InstructionSet set);

/// The settings' filter. The refined one tests triangles and knows neither bias nor softness: with a manual bias or a soft
/// edge the four texels are compared as `bilinear` does.
ShadowFilter filter_of(const ShadowSettings& settings);
/// The settings' manual values, or the automatic bias.
ShadowBias bias_of(const ShadowSettings& settings);

using LookUpShadowMap = void (*)(const ShadowMapTest& test, const SurfaceSamples& samples,
                                 std::span<const std::uint16_t> wanted, float* alpha);
LookUpShadowMap look_up_shadow_map_for(InstructionSet set);

}  // namespace laterna::shadow
