#include "scene/gltf_camera_writer.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "scene/gltf_light_extensions.h"
#include "scene/gltf_setting_writer.h"

namespace laterna::gltf {
namespace {

bool is_same(const Projection& a, const Projection& b) {
  return a.is_orthographic == b.is_orthographic && a.left == b.left && a.right == b.right &&
         a.bottom == b.bottom && a.top == b.top && a.near == b.near && a.far == b.far;
}

// A camera in glTF's own members, and what is read from them.
struct Plain {
  Json json;
  Camera camera;
};

Plain perspective(const Camera& camera) {
  const Projection& p = camera.projection;
  // About the axis, as wide as the widest side.
  constexpr double kWidest = kPi * 0.999999;
  Json best = {{"yfov", std::min(2 * arctangent(std::max(-p.bottom, p.top)), kWidest)}, {"znear", p.near}};
  const double width = std::max(-p.left, p.right), height = std::max(-p.bottom, p.top);
  if (!camera.aspect_from_picture) best["aspectRatio"] = std::clamp(width / height, 1e-30, 1e30);
  if (p.left == -p.right && p.bottom == -p.top) {
    Json exact = Json::object();
    set_frustum(exact, p, FrustumOf::camera, camera.aspect_from_picture);
    if (exact.contains("yfov")) {
      best["yfov"] = exact["yfov"];
      if (exact.contains("aspectRatio")) best["aspectRatio"] = exact["aspectRatio"];
    }
  }
  if (std::isfinite(p.far)) best["zfar"] = p.far;
  Plain plain;
  plain.camera.projection = Projection::perspective(Angle::radians(best["yfov"].get<double>()),
                                                    best.value("aspectRatio", 1.0), p.near, p.far);
  plain.camera.aspect_from_picture = camera.aspect_from_picture;
  plain.json = {{"type", "perspective"}, {"perspective", std::move(best)}};
  return plain;
}

Plain orthographic(const Camera& camera) {
  const Projection& p = camera.projection;
  const double xmag = std::max(-p.left, p.right), ymag = std::max(-p.bottom, p.top);
  // glTF's own cannot see what is behind the camera.
  const double near = std::max(p.near, 0.0), far = p.far > near ? p.far : near + 1;
  Plain plain;
  plain.camera.projection = Projection::orthographic(xmag, ymag, near, far);
  plain.camera.aspect_from_picture = false;
  plain.json = {{"type", "orthographic"},
                {"orthographic", {{"xmag", xmag}, {"ymag", ymag}, {"zfar", far}, {"znear", near}}}};
  return plain;
}

}  // namespace

void write_cameras(const Scene& scene, Document& document) {
  for (const Camera& camera : scene.cameras) {
    Plain plain = camera.projection.is_orthographic ? orthographic(camera) : perspective(camera);
    Json json;
    if (!camera.name.empty()) json["name"] = camera.name;
    json.update(plain.json);
    if (!is_same(plain.camera.projection, camera.projection) ||
        plain.camera.aspect_from_picture != camera.aspect_from_picture) {
      Json frustum = Json::object();
      set_frustum(frustum, camera.projection, FrustumOf::camera, camera.aspect_from_picture);
      document.extend(json, kLightingExtension, std::move(frustum));
    }
    document.add("cameras", std::move(json));
  }
}

}  // namespace laterna::gltf
