#include "image/octahedral_levels.h"

#include <utility>

#include "image/environment_chart.h"

namespace laterna::image {

std::size_t OctahedralLevels::add_level(int side) {
  levels.push_back({side, static_cast<std::uint32_t>(r.size())});
  const std::size_t count =
      r.size() + static_cast<std::size_t>(side + 2) * static_cast<std::size_t>(side + 2);
  for (AlignedVector<float>* plane : {&r, &g, &b}) plane->resize(count, 0.0F);
  return levels.size() - 1;
}

void OctahedralLevels::set(std::size_t level, const std::vector<glm::vec3>& texels) {
  const int side = levels[level].side;
  std::size_t next = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x, ++next) {
      const std::size_t at = index(level, x, y);
      r[at] = texels[next].x;
      g[at] = texels[next].y;
      b[at] = texels[next].z;
    }
  }
  fill_border(level);
}

// Beyond a side the chart goes on at the same side, from its other end.
void OctahedralLevels::fill_border(std::size_t level) {
  const int side = levels[level].side;
  const auto copy = [&](int to_x, int to_y, int from_x, int from_y) {
    const std::size_t to = index(level, to_x, to_y), from = index(level, from_x, from_y);
    r[to] = r[from];
    g[to] = g[from];
    b[to] = b[from];
  };
  const int last = side - 1;
  for (int i = 0; i < side; ++i) {
    copy(i, -1, last - i, 0);
    copy(i, side, last - i, last);
    copy(-1, i, 0, last - i);
    copy(side, i, last, last - i);
  }
  copy(-1, -1, last, last);
  copy(side, side, 0, 0);
  copy(side, -1, 0, last);
  copy(-1, side, last, 0);
}

namespace {

// Solid angles of texels, up to a factor.
std::vector<float> texel_weights(int side) {
  std::vector<float> weights;
  weights.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const PanelPoint middle{0, (2 * x + 1.0) / side - 1, (2 * y + 1.0) / side - 1};
      weights.push_back(static_cast<float>(panel_density(EnvironmentChart::octahedral, middle)));
    }
  }
  return weights;
}

}  // namespace

OctahedralLevels make_octahedral_pyramid(int side, const std::vector<glm::vec3>& texels) {
  OctahedralLevels pyramid;
  pyramid.set(pyramid.add_level(side), texels);
  std::vector<float> weights = texel_weights(side);
  for (int half = side / 2; half >= 4; half /= 2) {
    const std::size_t level = pyramid.add_level(half);
    std::vector<float> sums;
    sums.reserve(weights.size() / 4);
    for (int y = 0; y < half; ++y) {
      for (int x = 0; x < half; ++x) {
        glm::vec3 light(0);
        float sum = 0;
        for (int i = 0; i < 4; ++i) {
          const int from_x = 2 * x + i % 2, from_y = 2 * y + i / 2;
          const std::size_t from = pyramid.index(level - 1, from_x, from_y);
          const float weight = weights[static_cast<std::size_t>(from_y) * 2 * static_cast<std::size_t>(half) +
                                       static_cast<std::size_t>(from_x)];
          light += glm::vec3(pyramid.r[from], pyramid.g[from], pyramid.b[from]) * weight;
          sum += weight;
        }
        const std::size_t to = pyramid.index(level, x, y);
        pyramid.r[to] = light.x / sum;
        pyramid.g[to] = light.y / sum;
        pyramid.b[to] = light.z / sum;
        sums.push_back(sum);
      }
    }
    weights = std::move(sums);
    pyramid.fill_border(level);
  }
  return pyramid;
}

}  // namespace laterna::image
