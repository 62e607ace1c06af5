#include "reference/projector_scenes.h"

namespace laterna::reference {

int add_linear_picture(Scene& scene, int width, int height, const std::function<glm::vec3(int, int)>& pixel) {
  auto image = std::make_shared<Image>(width, height, 3, PixelType::f32, Transfer::linear);
  const std::span<float> values = image->values<float>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec3 c = pixel(x, y);
      const auto i = static_cast<std::size_t>((y * width + x) * 3);
      values[i] = c.r, values[i + 1] = c.g, values[i + 2] = c.b;
    }
  }
  Picture picture;
  picture.name = "linear picture " + std::to_string(scene.pictures.size());
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

Light projector(const std::string& name, double half_width, double half_height, int slide) {
  Light light;
  light.name = name;
  light.type = LightType::projector;
  light.projection = {false, -half_width, half_width, -half_height, half_height, 0.1, 1000};
  light.aspect_from_slide = false;
  light.slide = slide;
  return light;
}

View square_on(double half_height, double aspect, glm::dvec2 centre) {
  return {Pose::look_at({centre, 50}, {centre, 0}, {0, 1, 0}).value(),
          Projection::orthographic(half_height * aspect, half_height, 0, 100)};
}

RenderSettings papers_settings(int width, int height) {
  RenderSettings settings = test_settings(width, height);
  settings.shading = ShadingModel::papers;
  return settings;
}

}  // namespace laterna::reference
