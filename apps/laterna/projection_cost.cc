#include "projection_cost.h"

#include <algorithm>

namespace laterna::app {
namespace {

enum class Use { texture, slide };

int add_checks(Scene& scene) {
  constexpr int kSide = 512;
  constexpr int kField = 32;
  auto image = std::make_shared<Image>(kSide, kSide, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image->values<std::uint8_t>();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool is_light = (x / kField + y / kField) % 2 == 0;
      const auto i = static_cast<std::size_t>(y * kSide + x) * 3;
      for (std::size_t channel = 0; channel < 3; ++channel) values[i + channel] = is_light ? 220 : 40;
    }
  }
  Picture picture;
  picture.name = "checks";
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

// Texture coordinates for surfaces that have none: metres, seen from above.
void complete_coordinates(Primitive& primitive) {
  if (!primitive.uv[0].empty()) return;
  for (const glm::vec3& p : primitive.positions) primitive.uv[0].emplace_back(p.x, p.z);
}

// Every surface an opaque one, so that nothing but the one picture is looked up.
void put_plain_material(Scene& scene, int texture) {
  scene.materials.assign(1, Material());
  scene.materials[0].name = "plain";
  scene.materials[0].double_sided = true;
  scene.materials[0].base_color_texture.picture = texture;
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      primitive.material = 0;
      primitive.colors.clear();
      complete_coordinates(primitive);
    }
  }
}

Scene scene_for(Use use, const Subject& subject) {
  Scene scene = subject.renderer.scene();
  scene.warnings.clear();
  scene.clips.clear();  // it is posed as it is measured
  for (Light& light : scene.lights) light.enabled = false;
  const int picture = add_checks(scene);
  put_plain_material(scene, use == Use::texture ? picture : -1);
  scene.ambient = glm::vec3(use == Use::texture ? 1.0F : 0.0F);
  scene.ambient_is_set = true;
  if (use == Use::texture) return scene;
  Light light;
  light.name = "slide beside texture";
  light.type = LightType::projector;
  light.projection = subject.view.projection;
  light.aspect_from_slide = false;
  light.slide = picture;
  light.shadow.technique = ShadowTechnique::none;
  Node node;
  node.name = light.name;
  node.light = static_cast<int>(scene.lights.size());
  node.parent_from_node = subject.view.pose.world_from_view();
  scene.lights.push_back(std::move(light));
  scene.nodes.push_back(std::move(node));
  return scene;
}

Result<ProjectionCost::Rate> rate_of(Use use, const Subject& subject, const FrameSeries& series) {
  Result<Renderer> renderer = Renderer::create(
      scene_for(use, subject), {subject.renderer.threads(), subject.renderer.instruction_set()});
  if (!renderer) return tl::unexpected(std::move(renderer.error()));
  Subject drawn = {std::move(*renderer), subject.view, subject.settings, {}};
  drawn.settings.shading = ShadingModel::papers;
  const Result<FrameCosts> costs = draw_series(drawn, series);
  if (!costs) return tl::unexpected(costs.error());
  ProjectionCost::Rate rate;
  rate.ms = costs->frame().median;
  const double per_second = 1e3 / rate.ms / 1e6;
  rate.mtri_per_s = static_cast<double>(costs->last().triangles) * per_second;
  rate.mpix_per_s = static_cast<double>(drawn.settings.width) * drawn.settings.height * per_second;
  return rate;
}

}  // namespace

Result<ProjectionCost> measure_projection(const Subject& subject, const FrameSeries& series) {
  const Result<ProjectionCost::Rate> textured = rate_of(Use::texture, subject, series);
  if (!textured) return tl::unexpected(textured.error());
  const Result<ProjectionCost::Rate> projected = rate_of(Use::slide, subject, series);
  if (!projected) return tl::unexpected(projected.error());
  return ProjectionCost{*textured, *projected};
}

}  // namespace laterna::app
