// Rays that go on behind a surface, bent: where they end in a picture of what lies there. docs/mirrors.md
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "laterna/mirrors.h"
#include "raster/raster_view.h"
#include "shade/mirror_picture.h"

namespace laterna::shade {

/// Snell's law: the unit direction behind a surface of a unit ray that meets it from before, on the side of its unit normal; `index`:
/// that of what lies behind over that of what lies before. None: total reflection.
std::optional<glm::dvec3> refracted(const glm::dvec3& along, const glm::dvec3& normal, double index);

/// What is left of light that went so many metres, which may be infinitely many.
glm::vec3 attenuation(const MirrorVolume& volume, double metres);

class RefractedRay {
 public:
  /// From a place of the mirror, in a unit direction. `sampled_at`: where in its pixels the picture's sample lies, from their
  /// centres. All must outlive it.
  RefractedRay(const MirrorPicture& picture, const raster::RasterView& view, const glm::dvec3& place_ws,
               const glm::dvec3& direction_ws, glm::vec2 sampled_at);

  struct End {
    glm::vec2 place;  ///< of the picture, as MirrorPicture::interpolated() has it
    double distance;  ///< metres from the mirror; infinite where nothing is met
  };
  /// Where the ray meets what the picture shows. One that meets nothing ends as deep as what lies straight behind the mirror. One that
  /// passes behind something, where the picture does not look, ends as far on this side of where it did so: what is there goes on,
  /// turned over.
  [[nodiscard]] End find_end() const;

 private:
  // A place on the way, in the picture.
  struct Point {
    glm::vec2 place;
    double distance;  // metres along the view's axis
  };
  [[nodiscard]] Point at(double t) const;
  // How far a place on the way lies behind what the picture shows there, metres along the view's axis; −∞ where that is nothing.
  [[nodiscard]] double behind(const Point& point) const;
  // t between which and `after` the ray passes behind something; none: it does not meet it.
  [[nodiscard]] std::optional<double> meets(double before, double after) const;
  [[nodiscard]] double most() const;
  // Where the way is as deep as what the picture shows at another place of it; none: that is nothing.
  [[nodiscard]] std::optional<double> as_deep_as_seen_at(double t) const;
  [[nodiscard]] End endless() const;

  const MirrorPicture& picture_;
  const raster::RasterView& view_;
  glm::dvec3 from_;  // from the eye
  glm::dvec3 direction_;
  glm::dvec2 origin_;
  double sinking_;          // metres from the plane for each of the way
  double start_, advance_;  // along the view's axis: at the place, and for each metre of the way
};

}  // namespace laterna::shade
