// Charts of the sphere of directions: how pictures hold what is seen all around a point, which texel shows which
// direction, and what each costs. docs/environment.md
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "laterna/image.h"

namespace laterna {

/// Directions are those of docs/conventions.md: +Y up, −Z before a camera that is not turned. N is the chart's size.
enum class EnvironmentChart : std::uint8_t {
  /// 2N × N: longitude across, latitude down, +Y at the top; −Z in the middle and +X to its right.
  latlong,
  /// 6N × N: +X −X +Y −Y +Z −Z, each as OpenGL's table 8.19 has it (as seen from outside).
  cube,
  /// 4N × 3N: the faces of `cube` unfolded, −X +Z +X −Z in the middle row, +Y above and −Y below +Z.
  horizontal_cross,
  /// 3N × 4N: −X +Z +X in the second row, +Y above +Z, −Y and, turned by 180°, −Z below.
  vertical_cross,
  /// N × N: OpenGL's GL_SPHERE_MAP, what a mirror ball shows from far along +Z: +Z in the middle, −Z all along the rim.
  sphere,
  /// 2N × N: a disc about +Z at the left and one about −Z at the right, x to the right and y upward in both.
  dual_paraboloid,
  /// N × N: an octahedron unfolded, +Y in the middle, −Y at the four corners, +X at the right, +Z at the bottom.
  octahedral,
};

struct EnvironmentChartDescription {
  EnvironmentChart chart;
  std::string_view name;  ///< on the command line and in rigs
  int columns, rows;      ///< width and height in units of the size N
  std::string_view meaning;
};
/// All charts, in the order of the enumeration.
std::span<const EnvironmentChartDescription> list_environment_charts();
std::optional<EnvironmentChart> find_environment_chart(std::string_view name);

/// Largest size N that is made: 8192.
inline constexpr int kMaxEnvironmentSize = 8192;

/// Why a picture of this shape cannot be one of that chart; empty where it can.
std::string find_fault(EnvironmentChart chart, int width, int height);
/// What a picture of this shape most likely is: 2:1 latlong, 6:1 cube, 4:3 and 3:4 crosses; nothing for other shapes.
std::optional<EnvironmentChart> guess_environment_chart(int width, int height);

/// Where a direction is seen, as fractions of the picture's width and height from its top-left corner. The direction need
/// not be of unit length; it must not be 0.
glm::dvec2 image_from_direction(EnvironmentChart chart, const glm::dvec3& direction);
/// What is seen there, of unit length; nothing where the chart shows nothing.
std::optional<glm::dvec3> direction_from_image(EnvironmentChart chart, const glm::dvec2& position);

/// The solid angle in steradians of the part of a texel that shows directions, exact but for rounding (row 64). Over a
/// picture these add up to 4π. The picture must have a shape of the chart; 0 ≤ x < width, 0 ≤ y < height.
double texel_solid_angle(EnvironmentChart chart, int width, int height, int x, int y);

/// What a chart does to directions (row 64: "What's the best chart?"), measured at the centres of all texels of a picture.
struct ChartDistortion {
  double largest_solid_angle = 0,
         smallest_solid_angle = 0;  ///< sr per texel, of texels that are not cut by a rim
  double anisotropy = 0;            ///< longest over shortest extent of a texel, at worst
  double mean_anisotropy = 0;       ///< averaged over directions
  double unused_share = 0;          ///< of the picture's area, 0 … 1
  double coarsest_deg = 0;          ///< the longest extent of any texel
  /// Texels, in millions, of a picture of that chart in which no texel is longer than a tenth of a degree.
  double megatexels_at_tenth_deg = 0;
};
/// `size`: N, 8 … kMaxEnvironmentSize.
ChartDistortion measure_distortion(EnvironmentChart chart, int size);

/// The picture in another chart. Each texel is the mean over its solid angle; what lies between texels of the source is
/// interpolated across the edges of its faces and poles, without seams. Texels that show no direction are continued from
/// those beside them where the chart has a rim, and 0 in the corners of a cross. `size`: N; 0: as fine as the source.
/// Reads R, G, B or Y, writes the same. Errors: the picture has not the shape of its chart, the size is too large.
struct EnvironmentConversion {
  EnvironmentChart from = EnvironmentChart::latlong, to = EnvironmentChart::octahedral;
  int size = 0;
  int threads = 0;  ///< 0: one per processor
};
Result<LayeredImage> convert_environment(const LayeredImage& picture,
                                         const EnvironmentConversion& conversion);

}  // namespace laterna
