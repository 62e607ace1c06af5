#include "measure/seen_geometry.h"

#include <utility>

namespace laterna::measure {
namespace {

std::vector<glm::vec3> vectors(const LayeredImage& image, const std::string& layer) {
  const std::vector<float>& x = image.find(layer + ".X")->values;
  const std::vector<float>& y = image.find(layer + ".Y")->values;
  const std::vector<float>& z = image.find(layer + ".Z")->values;
  std::vector<glm::vec3> all(x.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {x[i], y[i], z[i]};
  return all;
}

}  // namespace

Result<SeenGeometry> draw_geometry(const Renderer& renderer, const View& view, RenderSettings settings) {
  settings.shadows = ShadowTechnique::none;
  settings.layers = {Layer::object, Layer::position, Layer::normal};
  Result<LayeredImage> drawn = renderer.render(view, settings);
  if (!drawn) return tl::unexpected(std::move(drawn.error()));
  SeenGeometry seen;
  seen.object = drawn->find("id.object")->values;
  seen.position_ws = vectors(*drawn, "P");
  seen.normal_ws = vectors(*drawn, "N");
  seen.unshadowed = std::move(*drawn);
  return seen;
}

}  // namespace laterna::measure
