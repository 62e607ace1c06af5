#include "render/picture_accumulation.h"

#include <algorithm>
#include <cmath>

#include "image/luminance.h"
#include "raster/triangle_bins.h"
#include "render/picture_writer.h"

namespace laterna::render {
namespace {

using raster::kTileSide;

constexpr const char* kRgb[] = {"R", "G", "B"};

// A tile's part of a plane of the picture; what lies beyond the picture stays as it is.
void read_tile(const AlignedVector<float>& plane, int width, int height, int tile_x, int tile_y,
               shade::TilePlane& tile) {
  const int columns = std::min(kTileSide, width - tile_x * kTileSide);
  const int rows = std::min(kTileSide, height - tile_y * kTileSide);
  for (int y = 0; y < rows; ++y) {
    const float* row = plane.data() +
                       static_cast<std::size_t>(tile_y * kTileSide + y) * static_cast<std::size_t>(width) +
                       tile_x * kTileSide;
    for (int x = 0; x < columns; ++x) tile[static_cast<std::size_t>(raster::index_in_tile(x, y))] = row[x];
  }
}

}  // namespace

PictureAccumulation::PictureAccumulation(const RenderSettings& settings, const frame::Frame& frame,
                                         const TaskPool& pool)
    : settings_(settings),
      pool_(pool),
      pixels_(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height)) {
  if (!has_layer(settings_, Layer::light)) settings_.layers.push_back(Layer::light);
  for (const PictureChannel& channel : picture_channels(settings_, frame)) {
    slots_.push_back({channel.name, channel.is_light, Plane(pixels_), Plane()});
    if (channel.is_light) slots_.back().sum.assign(pixels_, 0.0F);
  }
  alternating_.assign(pixels_, 0.0F);
}

RenderTarget PictureAccumulation::picture_target() {
  RenderTarget target;
  for (Slot& slot : slots_) {
    // Of data the first picture's is kept.
    if (!slot.is_light && count_ > 0) continue;
    target.channels.push_back({slot.name, slot.picture.data(), static_cast<std::size_t>(settings_.width)});
  }
  return target;
}

const PictureAccumulation::Slot& PictureAccumulation::slot(const std::string& name) const {
  return *std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) { return s.name == name; });
}

void PictureAccumulation::add() {
  pool_.for_each(slots_.size(), [&](std::size_t i, int) {
    Slot& slot = slots_[i];
    if (!slot.is_light) return;
    for (std::size_t k = 0; k < pixels_; ++k) slot.sum[k] += slot.picture[k];
  });
  const float sign = count_ % 2 == 0 ? 1.0F : -1.0F;
  const Plane &r = slot("R").picture, &g = slot("G").picture, &b = slot("B").picture;
  for (std::size_t k = 0; k < pixels_; ++k) {
    const float luminance = image::luminance(r[k], g[k], b[k]);
    alternating_[k] += sign * luminance;
    luminance_ += static_cast<double>(luminance);
  }
  ++count_;
  if (count_ % 2 == 0) noise_ = estimate_noise();
}

// Of N independent pictures, half of how the means of two halves differ has the variance of the mean.
double PictureAccumulation::estimate_noise() const {
  if (luminance_ <= 0) return 0;
  double squares = 0;
  for (const float difference : alternating_)
    squares += static_cast<double>(difference) * static_cast<double>(difference);
  return std::sqrt(squares * static_cast<double>(pixels_)) / luminance_;
}

// Channel 0, 1 or 2 of beauty from the layers.
void PictureAccumulation::sum_lights(int channel) {
  const std::string suffix = std::string(".") + kRgb[channel];
  const auto beauty =
      std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) { return s.name == kRgb[channel]; });
  beauty->picture = slot("ambient" + suffix).picture;
  for (const Slot& part : slots_) {
    const bool is_part = part.name.starts_with("light.") || part.name.starts_with("environment.") ||
                         part.name.starts_with("reflection.");
    if (!is_part || !part.name.ends_with(suffix)) continue;
    for (std::size_t k = 0; k < pixels_; ++k) beauty->picture[k] += part.picture[k];
  }
}

// In place of the last picture, which has been added.
void PictureAccumulation::find_mean() {
  const auto count = static_cast<float>(count_);
  pool_.for_each(slots_.size(), [&](std::size_t i, int) {
    Slot& slot = slots_[i];
    if (!slot.is_light) return;
    for (std::size_t k = 0; k < pixels_; ++k) slot.picture[k] = slot.sum[k] / count;
  });
  for (int channel = 0; channel < 3; ++channel) sum_lights(channel);
}

void PictureAccumulation::write(const RenderSettings& settings, const RenderTarget& target,
                                InstructionSet set, const frame::Frame& frame) {
  find_mean();
  const auto width = static_cast<std::size_t>(settings_.width);
  for (const ChannelTarget& channel : target.channels) {
    const Plane& mean = slot(channel.name).picture;
    for (std::size_t y = 0; y < static_cast<std::size_t>(settings_.height); ++y) {
      std::copy_n(mean.data() + y * width, width, channel.pixels + y * channel.row_stride);
    }
  }
  if (!target.color8) return;
  RenderTarget color;
  color.color8 = target.color8;
  const Result<PictureWriter> writer = PictureWriter::create(settings, color, frame, set);
  const int tiles_x = raster::tiles_across(settings_.width);
  const int tiles_y = raster::tiles_across(settings_.height);
  const auto tile = std::make_unique<shade::TileResult>();
  for (int y = 0; y < tiles_y; ++y) {
    for (int x = 0; x < tiles_x; ++x) {
      shade::TilePlane* planes[] = {&tile->beauty.r, &tile->beauty.g, &tile->beauty.b, &tile->alpha};
      const char* names[] = {"R", "G", "B", "A"};
      for (int i = 0; i < 4; ++i)
        read_tile(slot(names[i]).picture, settings_.width, settings_.height, x, y, *planes[i]);
      writer->write(x, y, *tile);
    }
  }
}

}  // namespace laterna::render
