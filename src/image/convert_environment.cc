// Pictures of all directions from chart to chart.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.h"
#include "base/refuse.h"
#include "image/environment_picture.h"

namespace laterna {
namespace {

constexpr std::array<std::string_view, 3> kColours = {"R", "G", "B"};

// R, G, B, or Y three times; empty where there is neither.
std::vector<glm::vec3> colours_of(const LayeredImage& picture) {
  std::array<const Channel*, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    channels[i] = picture.find(kColours[i]);
    if (channels[i] == nullptr) channels[i] = picture.find("Y");
    if (channels[i] == nullptr) return {};
  }
  std::vector<glm::vec3> texels(channels[0]->values.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    texels[i] = {channels[0]->values[i], channels[1]->values[i], channels[2]->values[i]};
  }
  return texels;
}

tl::unexpected<Error> bad_picture(std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, std::move(message)}));
}

// As many texels as the source has where it is finest on average.
int size_like(const image::EnvironmentPicture& source, EnvironmentChart to) {
  const image::ChartShape shape = image::chart_shape(to);
  const double wanted = 4 * kPi / (source.texel_side() * source.texel_side());
  const double panels = static_cast<double>(shape.panels.size()) * shape.panel_columns;
  const int size = static_cast<int>(std::lround(std::sqrt(wanted / panels)));
  return std::clamp(size, 1, kMaxEnvironmentSize);
}

}  // namespace

Result<LayeredImage> convert_environment(const LayeredImage& picture,
                                         const EnvironmentConversion& conversion) {
  if (std::string fault = find_fault(conversion.from, picture.width, picture.height); !fault.empty())
    return bad_picture(std::move(fault));
  if (conversion.size < 0 || conversion.size > kMaxEnvironmentSize)
    return refuse(fmt::format("the size must be from 1 to {}, got {}", kMaxEnvironmentSize, conversion.size));
  const std::vector<glm::vec3> texels = colours_of(picture);
  if (texels.empty()) return bad_picture("the picture has neither R, G, B nor Y");
  for (const glm::vec3& texel : texels) {
    if (!std::isfinite(texel.x + texel.y + texel.z))
      return bad_picture("the picture holds a value that is not finite");
  }
  const image::EnvironmentPicture source(conversion.from, picture.width, picture.height, texels);
  const image::ChartShape shape = image::chart_shape(conversion.to);
  // To its own chart at its own size a picture goes as it is: to filter it would only blur it.
  const bool is_own_chart = conversion.to == conversion.from;
  const int own_size = picture.height / shape.rows;
  int size = conversion.size;
  if (size == 0) size = is_own_chart ? own_size : size_like(source, conversion.to);
  const TaskPool pool(conversion.threads);
  const std::vector<glm::vec3> out =
      is_own_chart && size == own_size ? texels : image::resample(source, conversion.to, size, pool);
  LayeredImage converted;
  converted.width = shape.columns * size;
  converted.height = shape.rows * size;
  const bool is_grey = picture.find("R") == nullptr;
  for (int channel = 0; channel < (is_grey ? 1 : 3); ++channel) {
    Channel plane{is_grey ? "Y" : std::string(kColours[static_cast<std::size_t>(channel)]), {}};
    plane.values.reserve(out.size());
    for (const glm::vec3& texel : out) plane.values.push_back(texel[channel]);
    converted.channels.push_back(std::move(plane));
  }
  return converted;
}

}  // namespace laterna
