#include "shadow/moment_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::shadow {
namespace {

constexpr std::size_t kMostLevels = 8;
constexpr int kLeastSide = 4;
constexpr std::size_t kVector = 16;

std::size_t padded(std::size_t count) { return (count + kVector - 1) / kVector * kVector; }

std::vector<float> tent(float blur) {
  const int reach = static_cast<int>(std::ceil(blur));
  std::vector<double> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::max(0.0, 1 - std::abs(k) / (static_cast<double>(blur) + 1)));
    sum += weights.back();
  }
  std::vector<float> result;
  for (const double weight : weights) result.push_back(static_cast<float>(weight / sum));
  return result;
}

std::size_t channels_of(ShadowMoments kind) { return kind == ShadowMoments::variance ? 2 : 4; }

// The rows that a blurred one is made of, the first and last standing in for those beyond.
std::vector<const float*> rows_about(const float* first, std::size_t stride, int row, int rows,
                                     std::size_t taps) {
  std::vector<const float*> about;
  const int reach = static_cast<int>(taps / 2);
  for (int k = -reach; k <= reach; ++k) {
    about.push_back(first + static_cast<std::size_t>(std::clamp(row + k, 0, rows - 1)) * stride);
  }
  return about;
}

struct Extent {
  float nearest = std::numeric_limits<float>::infinity(), farthest = -std::numeric_limits<float>::infinity();
  void include(float distance) {
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  void include(const Extent& other) {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
  }
};

// Of the depths of one row of tiles; metres, or reversed depth turned round in an orthographic view.
Extent extent_of_tiles(const DepthMap& map, int tile_y) {
  Extent extent;
  const std::size_t row = static_cast<std::size_t>(map.tiles_x()) * raster::kTilePixels;
  const float* texels = map.texels() + static_cast<std::size_t>(tile_y) * row;
  for (std::size_t i = 0; i < row; ++i) {
    if (texels[i] == kNothingSeen) continue;
    extent.include(map.view().is_orthographic ? -texels[i] : 1 / texels[i]);
  }
  return extent;
}

}  // namespace

DepthMeasure find_depth_measure(std::span<const std::shared_ptr<DepthMap>> maps, ShadowDepth depth,
                                const TaskPool& pool) {
  DepthMeasure measure;
  measure.is_orthographic = maps[0]->view().is_orthographic;
  measure.is_radial = depth == ShadowDepth::radial && !measure.is_orthographic;
  Extent all;
  double longest = 1;  // ray, as a multiple of the distance along the axis
  for (const auto& map : maps) {
    std::vector<Extent> rows(static_cast<std::size_t>(map->tiles_y()));
    pool.for_each(rows.size(),
                  [&](std::size_t y, int) { rows[y] = extent_of_tiles(*map, static_cast<int>(y)); });
    for (const Extent& row : rows) all.include(row);
    const raster::RasterView& view = map->view();
    for (const double x : {-1.0 * view.origin_x, 1.0 * view.width - view.origin_x}) {
      for (const double y : {-1.0 * view.origin_y, 1.0 * view.height - view.origin_y}) {
        longest =
            std::max(longest, glm::length(view.direction_0 + view.direction_x * x + view.direction_y * y));
      }
    }
  }
  if (all.nearest > all.farthest) all = {0, 1};  // nothing was seen
  const double farthest = all.farthest * (measure.is_radial ? longest : 1.0);
  const double range = std::max(farthest - all.nearest, 1e-6 * std::max(std::abs(farthest), 1e-3));
  measure.nearest = measure.is_orthographic ? -all.nearest : all.nearest;
  measure.per_metre = static_cast<float>((1 + static_cast<double>(DepthMeasure::kFarthestDepth)) / range);
  return measure;
}

MomentMap::MomentMap(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind, float blur,
                     InstructionSet set, const TaskPool& pool) {
  const std::size_t channels = channels_of(kind);
  MomentLevel level = {map.width(), map.height(), 0};
  std::size_t texels = 0;
  for (;;) {
    level.first = texels;
    levels_.push_back(level);
    texels += static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    if (levels_.size() == kMostLevels || std::min(level.width, level.height) < 2 * kLeastSide) break;
    level.width = (level.width + 1) / 2;
    level.height = (level.height + 1) / 2;
  }
  moments_.resize(texels * channels + kVector * channels);  // kernels write whole vectors
  find_finest(map, measure, kind, blur, set, pool);
  for (std::size_t i = 1; i < levels_.size(); ++i) halve(i, channels, pool);
}

void MomentMap::find_finest(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind, float blur,
                            InstructionSet set, const TaskPool& pool) {
  const std::vector<float> weights = tent(blur);
  const std::size_t channels = channels_of(kind);
  const auto reach = static_cast<int>(weights.size() / 2);
  const auto width = static_cast<std::size_t>(map.width());
  const std::size_t stride = padded(width * channels);
  AlignedVector<float> across(stride * static_cast<std::size_t>(map.height()));
  const FindMoments find_moments = find_moments_for(set);
  const AddWeighted add_weighted = add_weighted_for(set);
  constexpr int kRows = 16;  // per task
  const auto tasks = static_cast<std::size_t>((map.height() + kRows - 1) / kRows);
  pool.for_each(tasks, [&](std::size_t task, int) {
    const std::size_t count = width + 2 * static_cast<std::size_t>(reach);
    AlignedVector<float> row((padded(count) + kVector) * channels);
    std::vector<const float*> shifted;
    for (std::size_t k = 0; k < weights.size(); ++k) shifted.push_back(row.data() + k * channels);
    const int first = static_cast<int>(task) * kRows;
    for (int y = first; y < std::min(first + kRows, map.height()); ++y) {
      find_moments(map, measure, kind, -reach, y, count, row.data());
      add_weighted(weights, shifted, width * channels, across.data() + static_cast<std::size_t>(y) * stride);
    }
  });
  pool.for_each(tasks, [&](std::size_t task, int) {
    AlignedVector<float> sum(stride);
    const int first = static_cast<int>(task) * kRows;
    for (int y = first; y < std::min(first + kRows, map.height()); ++y) {
      add_weighted(weights, rows_about(across.data(), stride, y, map.height(), weights.size()),
                   width * channels, sum.data());
      std::copy_n(sum.data(), width * channels,
                  moments_.data() + static_cast<std::size_t>(y) * width * channels);
    }
  });
}

void MomentMap::halve(std::size_t level, std::size_t channels, const TaskPool& pool) {
  const MomentLevel& finer = levels_[level - 1];
  const MomentLevel& coarser = levels_[level];
  const auto texel = [&](int x, int y) {
    const auto column = static_cast<std::size_t>(std::min(x, finer.width - 1));
    const auto row = static_cast<std::size_t>(std::min(y, finer.height - 1));
    return moments_.data() + (finer.first + row * static_cast<std::size_t>(finer.width) + column) * channels;
  };
  pool.for_each(static_cast<std::size_t>(coarser.height), [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    float* to = moments_.data() + (coarser.first + row * static_cast<std::size_t>(coarser.width)) * channels;
    for (int x = 0; x < coarser.width; ++x) {
      const float* from[4] = {texel(2 * x, 2 * y), texel(2 * x + 1, 2 * y), texel(2 * x, 2 * y + 1),
                              texel(2 * x + 1, 2 * y + 1)};
      for (std::size_t c = 0; c < channels; ++c) {
        *to++ = ((from[0][c] + from[1][c]) + (from[2][c] + from[3][c])) * 0.25F;
      }
    }
  });
}

}  // namespace laterna::shadow
