// Rays that go on behind a surface, bent or mirrored: where they end in a picture of what is seen there. docs/mirrors.md
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "raster/raster_view.h"
#include "shade/mirror_picture.h"

namespace laterna::shade {

class PictureRay {
 public:
  /// From a place of the mirror, in a unit direction away from the eye, through the space behind the plane: what is refracted lies
  /// there, and what is mirrored seems to. `view`: whose pixels the picture's are: the eye's where it is mirrored, its own where
  /// it is refracted. `sampled_at`: where in its pixels the picture's sample lies, from their centres. All must outlive it.
  PictureRay(const MirrorPicture& picture, const raster::RasterView& view, const glm::dvec3& place_ws,
             const glm::dvec3& direction_ws, glm::vec2 sampled_at);

  struct End {
    glm::vec2 place;  ///< of the picture, as MirrorPicture::interpolated() has it
    double distance;  ///< metres from the mirror; infinite where nothing is met
  };
  /// Where the ray meets what the picture shows. One that meets nothing ends as deep as what lies straight behind the mirror. One that
  /// passes behind something, where the picture does not look, ends as far on this side of where it did so: what is there goes on,
  /// turned over.
  [[nodiscard]] End find_end() const;
  /// The place alone. A ray that meets nothing goes on without end, and one that leaves the foot of what stands on the mirror ends
  /// there. One that passes behind something ends before it does, if what hides it hides its end without end too.
  [[nodiscard]] glm::vec2 find_end_in_sight() const;
  /// Of the place that it comes from, metres along the axis of the picture's view.
  [[nodiscard]] double start() const { return start_; }

 private:
  // A place on the way, in the picture.
  struct Point {
    glm::vec2 place;
    double distance;  // metres along the view's axis
  };
  [[nodiscard]] Point at(double t) const;
  // Where the way is 1 / nearness metres deep along the view's axis.
  [[nodiscard]] glm::vec2 place_as_near_as(float nearness) const;
  // How far a place on the way lies behind what the picture shows there, metres along the view's axis; −∞ where that is nothing.
  [[nodiscard]] double behind(const Point& point) const;
  // t between which and `after` the ray passes behind something; none: it does not meet it.
  [[nodiscard]] std::optional<double> meets(double before, double after) const;
  // The last place before the picture shows nothing, where what it shows there lies within two pixels of the way.
  [[nodiscard]] std::optional<glm::vec2> meets_foot(glm::dvec2 open) const;
  // Likewise, where the start itself shows what lies behind: the middle of the pixel beside it that shows the foot.
  [[nodiscard]] std::optional<glm::vec2> foot_beside() const;
  // The end where one surface is all that the picture shows from where the ray starts to where it ends, found in three looks. None:
  // depths leap on the way.
  [[nodiscard]] std::optional<glm::vec2> find_end_on_one_surface() const;
  [[nodiscard]] double most() const;
  struct March {
    std::optional<double> met, last_seen;  // t; last_seen: before it first passed behind something
    glm::dvec2 open{0};  // t of the last step before something, and of the one after it; 0: there is none
  };
  [[nodiscard]] March march(double most) const;
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
