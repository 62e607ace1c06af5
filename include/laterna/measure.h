// Looking into a picture: a point in every coordinate system, and depth made visible.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna {

/// The planes that glTexGen with GL_EYE_LINEAR and GL_EYE_PLANE would hold for a light and a camera, set while the modelview
/// matrix is the identity (Segal et al. 1992, section 3: texture coordinates made from a vertex's own position; row 33 of the
/// papers' list). With x_e the position in the camera's space, (x, y, z, 1), the generated coordinates are
///
///     s = S · x_e,   t = T · x_e,   r = R · x_e,   q = Q · x_e
///
/// and the look-up is at s/q, t/q, r/q: s and t from the slide's top-left corner, r the shadow map's depth, each in 0…1 within
/// the light's frustum. They are the rows of image_from_world (light) · world_from_view (camera).
struct EyeLinearPlanes {
  glm::dvec4 s{0}, t{0}, r{0}, q{0};
  /// (s/q, t/q, r/q) of a position in the camera's space, metres. Infinite or NaN where q is 0: beside the lens.
  [[nodiscard]] glm::dvec3 texture_at(const glm::dvec3& position_es) const;
};
EyeLinearPlanes eye_linear_planes(const View& camera, const View& light);

/// A world point in the five coordinate systems of Segal et al. 1992, section 2 and 3.
struct PointReport {
  glm::dvec3 world{0};
  glm::dvec4 clip{0};     ///< clip_from_world · world
  glm::dvec2 screen{0};   ///< clip x and y over w, −1…1, y up
  glm::dvec2 pixel{0};    ///< (0, 0) the top-left corner of the picture
  glm::dvec4 light{0};    ///< light_from_world · world, homogeneous (x^l, y^l, z^l, w^l)
  glm::dvec3 texture{0};  ///< slide or shadow map: s, t from the top-left corner, 0…1, and depth 0…1
  /// Projectors: place on the slide, 0…1 from its top-left corner, with the distortion of the lens; without distortion
  /// s and t of `texture`. Nothing behind the lens, or where it throws nothing.
  std::optional<glm::dvec2> slide;
  double distance = 0;     ///< from the light along its axis, metres
  bool is_ahead = false;   ///< in front of the lens
  bool is_inside = false;  ///< and within the frame

  glm::dmat4 clip_from_world{1.0};     ///< M_c
  glm::dmat4 light_from_world{1.0};    ///< M_l
  glm::dmat4 texture_from_world{1.0};  ///< M_l with scale and bias folded in
  EyeLinearPlanes eye_linear;          ///< the same, from the camera's space
};
/// Error: no light of that name, or one that shines all round.
Result<PointReport> inspect_point(const Renderer& renderer, const View& camera, int width, int height,
                                  const std::string& light, const glm::dvec3& point_ws);

/// Grey ramp of a channel "Z": the nearest is light, the farthest dark, where nothing is is white (MIT 6.837, lecture
/// 20, slide 11). R, G and B, linear.
Result<LayeredImage> depth_picture(const LayeredImage& depth);

/// The light's depth map thrown back on the scene (document 003): every surface shows the grey that the map holds for
/// it. Surfaces outside the map are black. The sky is the background.
Result<LayeredImage> projected_depth(const Renderer& renderer, const View& camera,
                                     const RenderSettings& settings, const std::string& light);

/// A picture that shows numbers as colours, and what each colour means, a line each.
struct ExplainedPicture {
  LayeredImage picture;  ///< R, G, B, linear
  std::vector<std::string> legend;
};

/// Which of a directional light's cascades answers for each surface, by colour, mixed where two are blended.
/// Error: no such light, or it has no cascades.
Result<ExplainedPicture> cascade_picture(const Renderer& renderer, const View& camera,
                                         const RenderSettings& settings, const std::string& light);

/// How finely a light's shadow maps are sampled: shadow texels along one pixel, both taken square to what looks at them
/// (perspective aliasing, as Stamminger and Drettakis, Perspective shadow maps, 2002, have it). Fewer than one shows
/// as blocks with plain filters. The legend also tells texels per metre.
/// Error: no such light, or its technique draws no maps.
Result<ExplainedPicture> texel_density_picture(const Renderer& renderer, const View& camera,
                                               const RenderSettings& settings, const std::string& light);

/// Which objects a light with projected silhouettes lets shade which (Chen and Tung, section 3; rows 38 to 40 and 47).
/// Each object that is in a pair has a colour of its own; one that others may shade is striped with their colours; what
/// is in no pair is grey. The legend lists the pairs.
/// Error: no such light, its technique is another one, or there are fewer than two objects that cast or receive.
Result<ExplainedPicture> shadow_pairs_picture(const Renderer& renderer, const View& camera,
                                              const RenderSettings& settings, const std::string& light);

/// A gain for each photograph of the scene, per channel, that makes photographs agree where several see the same surface:
/// exposure and white balance. The least squares, over all pairs that overlap, of the logarithms' medians (Brown and Lowe,
/// Automatic panoramic image stitching using invariant features, 2007, section 6, in stops and without a pull toward 1); the
/// gains' geometric mean is 1 among photographs that are linked by overlaps. Renderer::set_photograph_gains() takes them.
Result<std::vector<glm::vec3>> balance_photographs(const Renderer& renderer, const Progress& progress = {});

}  // namespace laterna
