#include "laterna/thrown_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/elementary.h"
#include "laterna/probes.h"
#include "measure/seen_geometry.h"

namespace laterna {
namespace {

constexpr glm::dvec2 kMiddle(0.5, 0.5);

// Places of the slide in space: its rays.
class Rays {
 public:
  Rays(const Renderer& renderer, const std::string& projector) : renderer_(renderer), projector_(projector) {}

  struct Ray {
    glm::dvec3 from, direction;  // of which the part along the projector's axis is 1
  };
  [[nodiscard]] Result<Ray> through(glm::dvec2 slide) const {
    const Result<glm::dvec3> near = renderer_.world_from_slide(projector_, slide, 1);
    const Result<glm::dvec3> far = renderer_.world_from_slide(projector_, slide, 2);
    if (!near) return tl::unexpected(near.error());
    if (!far) return tl::unexpected(far.error());
    return Ray{2.0 * *near - *far, *far - *near};
  }

 private:
  const Renderer& renderer_;
  const std::string& projector_;
};

// A point of a surface, and which way it faces.
struct Hit {
  glm::dvec3 point, normal;
};

// What is seen along a ray, through three by three pixels about it: the outer ones tell how the surface lies.
Result<std::optional<Hit>> find_hit(const Renderer& renderer, const Rays::Ray& ray, double near) {
  constexpr int kSide = 3;
  constexpr double kPixel =
      0.002;  // tangent: wide enough for single precision, narrow enough for most surfaces
  const bool is_steep = std::abs(ray.direction.y) > 0.9 * glm::length(ray.direction);
  const Result<Pose> pose =
      Pose::look_at(ray.from, ray.from + ray.direction, is_steep ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
  if (!pose) return tl::unexpected(pose.error());
  Projection narrow;
  narrow.left = narrow.bottom = -kPixel * kSide / 2;
  narrow.right = narrow.top = kPixel * kSide / 2;
  narrow.near = near;
  RenderSettings settings;
  settings.width = settings.height = kSide;
  const Result<measure::SeenGeometry> seen = measure::draw_geometry(renderer, {*pose, narrow}, settings);
  if (!seen) return tl::unexpected(seen.error());
  constexpr std::size_t kAt = 4, kLeft = 3, kRight = 5, kAbove = 1, kBelow = 7;
  if (seen->object[kAt] < 0) return std::nullopt;
  const auto point = [&](std::size_t i) { return glm::dvec3(seen->position_ws[i]); };
  glm::dvec3 normal(seen->normal_ws[kAt]);
  const bool is_one = std::ranges::all_of(std::array{kLeft, kRight, kAbove, kBelow}, [&](std::size_t i) {
    return seen->object[i] == seen->object[kAt];
  });
  if (is_one) normal = glm::cross(point(kRight) - point(kLeft), point(kAbove) - point(kBelow));
  normal = glm::normalize(glm::dot(normal, ray.direction) > 0 ? -normal : normal);
  return Hit{point(kAt), normal};
}

// Where a ray meets the plane, ahead of the lens.
std::optional<glm::dvec3> meet(const Rays::Ray& ray, const Hit& plane) {
  const double toward = glm::dot(ray.direction, plane.normal);
  const double along = glm::dot(plane.point - ray.from, plane.normal) / toward;
  if (!(toward < 0) || !(along > 0) || !std::isfinite(along)) return std::nullopt;
  return ray.from + along * ray.direction;
}

// Of places of the slide; nothing where one does not meet the plane.
template <std::size_t kCount>
Result<std::optional<std::array<glm::dvec3, kCount>>> meet_all(const Rays& rays, const Hit& plane,
                                                               const std::array<glm::dvec2, kCount>& places) {
  std::array<glm::dvec3, kCount> points;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Result<Rays::Ray> ray = rays.through(places[i]);
    if (!ray) return tl::unexpected(ray.error());
    const std::optional<glm::dvec3> point = meet(*ray, plane);
    if (!point) return std::nullopt;
    points[i] = *point;
  }
  return points;
}

struct Pixels {
  int across = 0, down = 0;
};

Pixels pixels_of(const Light& light, const Scene& scene) {
  if (light.panel_width > 0 && light.panel_height > 0) return {light.panel_width, light.panel_height};
  if (light.slide < 0) return {};
  const Picture& picture = scene.pictures[static_cast<std::size_t>(light.slide)];
  if (picture.pixels != nullptr) return {picture.pixels->width(), picture.pixels->height()};
  if (picture.film) {
    const Result<FilmHeader> film = read_film_header(picture.file, picture.film->frames_per_second);
    return film ? Pixels{film->width, film->height} : Pixels{};
  }
  const Result<ImageHeader> header = picture.encoded.empty()
                                         ? read_image_header(picture.file)
                                         : read_image_header(picture.encoded, picture.name);
  return header ? Pixels{header->width, header->height} : Pixels{};
}

// The light with a white slide of the same shape, and with nothing in its way.
Result<Light> whitened(const Light& light, const Rays& rays) {
  Light white = light;
  white.shadow.technique = ShadowTechnique::none;
  white.aperture = {};
  white.source = {};
  if (light.slide_is_intensity) return white;
  white.slide = -1;
  if (!light.aspect_from_slide) return white;
  const Result<Rays::Ray> left = rays.through({0, 0.5}), right = rays.through({1, 0.5});
  const Result<Rays::Ray> top = rays.through({0.5, 0}), bottom = rays.through({0.5, 1});
  if (!left || !right || !top || !bottom) return white;
  const auto apart = [](const Rays::Ray& a, const Rays::Ray& b) {
    return glm::length(a.from + a.direction - b.from - b.direction);
  };
  Projection& frame = white.projection;
  const double half_width = (frame.top - frame.bottom) / 2 * apart(*left, *right) / apart(*top, *bottom);
  const double middle = (frame.left + frame.right) / (frame.right - frame.left) * half_width;
  frame.left = middle - half_width;
  frame.right = middle + half_width;
  white.aspect_from_slide = false;
  return white;
}

// What a meter at the hit reads of the light alone: the shading's own answer.
Result<double> read_lux(const Renderer& renderer, const Light& light, const Pose& pose, const Hit& hit) {
  Scene alone;
  alone.pictures = renderer.scene().pictures;
  alone.lights = {light};
  alone.ambient_is_set = true;
  Node& node = alone.nodes.emplace_back();
  node.light = 0;
  node.parent_from_node = pose.world_from_view();
  RendererOptions options;
  options.threads = 1;
  options.instruction_set = renderer.instruction_set();
  options.time = renderer.time();
  const Result<Renderer> dark_room = Renderer::create(std::move(alone), options);
  if (!dark_room) return tl::unexpected(dark_room.error());
  const Probe probe = {hit.point, hit.normal, 0};
  const Result<ProbeReport> report = dark_room->measure_probes({&probe, 1}, {});
  if (!report) return tl::unexpected(report.error());
  return report->readings.front().lux;
}

}  // namespace

Result<std::optional<ThrownPicture>> find_thrown_picture(const Renderer& renderer,
                                                         const std::string& projector) {
  const Rays rays(renderer, projector);
  const Result<Rays::Ray> middle = rays.through(kMiddle);
  if (!middle) return tl::unexpected(middle.error());
  const Scene& scene = renderer.scene();
  const int node = find_light_node(scene, projector);
  const Light& light =
      scene.lights[static_cast<std::size_t>(scene.nodes[static_cast<std::size_t>(node)].light)];
  const Result<Pose> pose = Pose::from_matrix(world_from_nodes(scene)[static_cast<std::size_t>(node)]);
  if (!pose) return tl::unexpected(pose.error());
  constexpr double kNearest = 1e-3;
  const Result<std::optional<Hit>> found =
      find_hit(renderer, *middle, std::max(light.projection.near, kNearest));
  if (!found) return tl::unexpected(found.error());
  if (!*found) return std::nullopt;
  const Hit& hit = **found;

  ThrownPicture thrown;
  thrown.light = projector;
  thrown.middle_ws = hit.point;
  thrown.normal_ws = hit.normal;
  thrown.throw_distance = glm::dot(hit.point - middle->from, pose->forward_ws());
  const double cosine = -glm::dot(glm::normalize(middle->direction), hit.normal);
  thrown.incidence = Angle::radians(arccosine(std::clamp(cosine, -1.0, 1.0)));
  const auto corners = meet_all<4>(rays, hit, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  const auto sides = meet_all<4>(rays, hit, {{{0, 0.5}, {1, 0.5}, {0.5, 0}, {0.5, 1}}});
  if (!corners) return tl::unexpected(corners.error());
  if (!sides) return tl::unexpected(sides.error());
  thrown.corners_ws = *corners;
  if (*corners && *sides) {
    const std::array<glm::dvec3, 4>& s = **sides;
    thrown.size = glm::dvec2(glm::distance(s[0], s[1]), glm::distance(s[2], s[3]));
  }
  const Pixels pixels = pixels_of(light, scene);
  thrown.pixels_across = pixels.across;
  thrown.pixels_down = pixels.down;
  if (thrown.size && pixels.across > 0)
    thrown.pixel_pitch = *thrown.size / glm::dvec2(pixels.across, pixels.down);
  const Result<Light> white = whitened(light, rays);
  if (!white) return tl::unexpected(white.error());
  const Result<double> lux = read_lux(renderer, *white, *pose, hit);
  if (!lux) return tl::unexpected(lux.error());
  thrown.lux = *lux;
  return thrown;
}

}  // namespace laterna
