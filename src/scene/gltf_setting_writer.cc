#include "scene/gltf_setting_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/elementary.h"
#include "scene/setting_names.h"

namespace laterna::gltf {
namespace {

// Of a lens, as far as it is read (scene/rig_frustum.cc): heights and widths of the picture.
constexpr double kMostShift = 100;

// The numbers next to one, nearest first: of those from which it may have been calculated, one gives its very bits.
constexpr int kNeighbours = 6;
std::array<double, 2 * kNeighbours + 1> neighbours(double value) {
  std::array<double, 2 * kNeighbours + 1> numbers{};
  numbers[0] = value;
  double below = value, above = value;
  for (std::size_t i = 1; i < numbers.size(); i += 2) {
    numbers[i] = below = std::nextafter(below, -std::numeric_limits<double>::infinity());
    numbers[i + 1] = above = std::nextafter(above, std::numeric_limits<double>::infinity());
  }
  return numbers;
}

// What someone may have typed to come to this.
std::array<double, 3> typed(double value) {
  constexpr double kSixDigits = 1e6, kNineDigits = 1e9;
  return {value, std::round(value * kSixDigits) / kSixDigits, std::round(value * kNineDigits) / kNineDigits};
}

bool is_same(const Projection& a, const Projection& b) {
  return a.left == b.left && a.right == b.right && a.bottom == b.bottom && a.top == b.top;
}

struct Opening {
  double yfov_or_height, aspect;
  std::optional<glm::dvec2> shift;
};

Projection made(const Opening& opening, const Projection& like) {
  const Projection projection =
      like.is_orthographic ? Projection::orthographic(opening.yfov_or_height / 2 * opening.aspect,
                                                      opening.yfov_or_height / 2, like.near, like.far)
                           : Projection::perspective(Angle::radians(opening.yfov_or_height), opening.aspect,
                                                     like.near, like.far);
  return opening.shift ? projection.shifted(opening.shift->x, opening.shift->y) : projection;
}

// Nothing where no yfov, aspect and shift make just these sides.
std::optional<Opening> find_opening(const Projection& p, bool aspect_from_picture) {
  const double width = p.right - p.left, height = p.top - p.bottom;
  const bool is_centred = p.left == -p.right && p.bottom == -p.top;
  const double yfov_or_height = p.is_orthographic ? height : 2 * arctangent(height / 2);
  std::vector<double> aspects = {1};
  if (!aspect_from_picture) {
    const auto near = neighbours(width / height);
    const auto likely = typed(width / height);
    aspects.assign(likely.begin(), likely.end());
    aspects.insert(aspects.end(), near.begin(), near.end());
  }
  std::vector<std::optional<glm::dvec2>> shifts = {std::nullopt};
  if (!is_centred) {
    shifts.clear();
    for (const double x : typed((p.left + p.right) / 2 / width)) {
      for (const double y : typed((p.bottom + p.top) / 2 / height)) {
        if (std::max(std::abs(x), std::abs(y)) <= kMostShift) shifts.emplace_back(glm::dvec2(x, y));
      }
    }
  }
  for (const double size : neighbours(yfov_or_height)) {
    const bool is_opening = size > 0 && (p.is_orthographic || size < kPi);
    for (const double aspect : aspects) {
      if (!(aspect > 0) || std::isinf(aspect)) continue;
      for (const auto& shift : shifts) {
        const Opening opening{size, aspect, shift};
        if (is_opening && is_same(made(opening, p), p)) return opening;
      }
    }
  }
  return std::nullopt;
}

struct Named {
  std::string_view name;
  int value;
};

template <class Enumeration, std::size_t N>
void set_word(Json& object, std::string_view name, Enumeration value, Enumeration usual,
              const Named (&words)[N]) {
  if (value == usual) return;
  const auto* found = std::find_if(std::begin(words), std::end(words), [&](const Named& entry) {
    return entry.value == static_cast<int>(value);
  });
  if (found != std::end(words)) set(object, name, word(found->name));
}

template <class Enumeration>
constexpr int code(Enumeration value) {
  return static_cast<int>(value);
}

void set_map(Json& shadow, const ShadowSettings& s, const ShadowSettings& usual) {
  constexpr Named kFilters[] = {{"refined", code(ShadowFilter::refined)},
                                {"nearest", code(ShadowFilter::nearest)},
                                {"bilinear", code(ShadowFilter::bilinear)},
                                {"percentage_closer", code(ShadowFilter::percentage_closer)},
                                {"averaged_depths", code(ShadowFilter::averaged_depths)}};
  constexpr Named kFaces[] = {{"both", code(CasterFaces::both)}, {"back_only", code(CasterFaces::back_only)}};
  constexpr Named kDepths[] = {{"planar", code(ShadowDepth::planar)}, {"radial", code(ShadowDepth::radial)}};
  constexpr Named kLayouts[] = {{"cube", code(ShadowLayout::cube)},
                                {"dual_paraboloid", code(ShadowLayout::dual_paraboloid)}};
  constexpr Named kWarps[] = {{"none", code(ShadowWarp::none)},
                              {"light_space_perspective", code(ShadowWarp::light_space_perspective)}};
  set_unless(shadow, "resolution", s.resolution, usual.resolution);
  set_word(shadow, "filter", s.filter, usual.filter, kFilters);
  if (s.filter == ShadowFilter::percentage_closer || s.filter == ShadowFilter::averaged_depths)
    set_unless(shadow, "kernel", s.kernel, usual.kernel);
  if (s.constant_bias) set(shadow, "constant_bias", *s.constant_bias);
  if (s.slope_bias) set(shadow, "slope_bias", *s.slope_bias);
  set_word(shadow, "caster_faces", s.caster_faces, usual.caster_faces, kFaces);
  if (!s.outside_is_lit) set(shadow, "outside", word("shadowed"));
  set_word(shadow, "depth", s.depth, usual.depth, kDepths);
  if (s.soft_edge != usual.soft_edge) set(shadow, "soft_edge", s.soft_edge);
  set_word(shadow, "layout", s.layout, usual.layout, kLayouts);
  set_word(shadow, "warp", s.warp, usual.warp, kWarps);
}

void set_moments(Json& shadow, const ShadowSettings& s, const ShadowSettings& usual) {
  constexpr Named kMoments[] = {{"variance", code(ShadowMoments::variance)},
                                {"exponential", code(ShadowMoments::exponential)}};
  set_word(shadow, "moments", s.moments, usual.moments, kMoments);
  if (s.bleeding_reduction != usual.bleeding_reduction)
    set(shadow, "bleeding_reduction", shortest(s.bleeding_reduction));
  if (s.blur != usual.blur) set(shadow, "blur", shortest(s.blur));
}

void set_planes(Json& shadow, const ShadowSettings& s) {
  if (s.planes.empty()) return;
  Json planes = Json::array();
  for (const ShadowPlane& plane : s.planes)
    planes.push_back({{"normal", components(plane.normal)}, {"distance", plane.distance}});
  shadow["planes"] = std::move(planes);
}

void set_silhouette(Json& shadow, const ShadowSettings& s) {
  set_unless(shadow, "smooth", s.smooth, 0);
  if (s.smooth > 0 && s.smooth_kernel == SmoothKernel::binomial)
    set(shadow, "smooth_kernel", word("binomial"));
  if (!s.orders_objects) shadow["order"] = "none";
  if (!s.culls_occluders) shadow["cull"] = false;
}

void set_cascades(Json& shadow, const ShadowSettings& s, const ShadowSettings& usual) {
  set_unless(shadow, "cascades", s.cascades, usual.cascades);
  if (s.split_lambda != usual.split_lambda) set(shadow, "split_lambda", s.split_lambda);
  if (s.cascade_distance != usual.cascade_distance) set(shadow, "cascade_distance", s.cascade_distance);
}

void set_darkness(Json& shadow, const ShadowSettings& s, const ShadowSettings& usual) {
  if (s.color != usual.color) shadow["color"] = components(s.color);
  set_unless(shadow, "opacity", shortest(s.opacity), shortest(usual.opacity));
  set_unless(shadow, "ambient", shortest(s.ambient), shortest(usual.ambient));
  set_unless(shadow, "fill", shortest(s.fill), shortest(usual.fill));
}

}  // namespace

void set(Json& object, std::string_view rig_name, Json value) {
  object[std::string(kGltfNames.spelled(rig_name))] = std::move(value);
}

Json word(std::string_view rig_word) { return std::string(kGltfNames.spelled(rig_word)); }

Json sides(const Projection& p) {
  Json json = {{"left", p.left}, {"right", p.right}, {"bottom", p.bottom}, {"top", p.top}};
  return json;
}

void set_frustum(Json& object, const Projection& p, FrustumOf of, bool aspect_from_picture) {
  if (const auto opening = find_opening(p, aspect_from_picture)) {
    if (p.is_orthographic) {
      object["orthographic"] = {{"height", opening->yfov_or_height}};
    } else {
      set(object, "yfov_deg", opening->yfov_or_height);
    }
    if (!aspect_from_picture) set(object, "aspect", opening->aspect);
    if (opening->shift) set(object, "lens_shift", {opening->shift->x, opening->shift->y});
  } else {
    object["frustum"] = sides(p);
    if (p.is_orthographic) object["frustum"]["parallel"] = true;
    if (aspect_from_picture)
      set(object, of == FrustumOf::camera ? "aspect_from_picture" : "aspect_from_slide", true);
  }
  set(object, "near", p.near);
  if (std::isfinite(p.far)) set(object, "far", p.far);
}

Json shadow_json(const ShadowSettings& s) {
  const ShadowSettings usual;
  Json shadow = Json::object();
  if (s.technique) {
    for (const TechniqueDescription& known : list_techniques()) {
      if (known.technique == *s.technique) shadow["technique"] = word(known.name);
    }
  }
  set_map(shadow, s, usual);
  set_moments(shadow, s, usual);
  set_planes(shadow, s);
  set_silhouette(shadow, s);
  set_cascades(shadow, s, usual);
  set_darkness(shadow, s, usual);
  return shadow;
}

}  // namespace laterna::gltf
