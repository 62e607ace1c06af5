#include "frame/relief_field.h"

#include <algorithm>
#include <vector>

namespace laterna::frame {
namespace {

ReliefField::Axis make_axis(int texels, Wrap wrap) {
  const auto scale = static_cast<float>(texels);
  // Elsewhere than in repetitions the outermost texels are there twice, around cells across which it is level: without end
  // where the lattice ends, folded in the middle where it is mirrored.
  return wrap == Wrap::repeat ? ReliefField::Axis{texels, wrap, scale, -0.5F}
                              : ReliefField::Axis{texels + 1, wrap, scale, 0.5F};
}

// The texel of each corner.
std::vector<int> texels_of(const ReliefField::Axis& axis, int texels) {
  std::vector<int> of_corner(static_cast<std::size_t>(axis.cells) + 1);
  for (int i = 0; i <= axis.cells; ++i) {
    const int texel = axis.wrap == Wrap::repeat ? i % texels : std::clamp(i - 1, 0, texels - 1);
    of_corner[static_cast<std::size_t>(i)] = texel;
  }
  return of_corner;
}

class PyramidBuilder {
 public:
  explicit PyramidBuilder(ReliefField& field)
      : field_(field), width_(field.x.cells), height_(field.y.cells) {}

  void build() {
    start_level();
    const std::size_t row = static_cast<std::size_t>(field_.x.cells) + 1;
    for (int j = 0; j < height_; ++j) {
      for (int i = 0; i < width_; ++i) {
        const float* corner =
            field_.corners.data() + static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i);
        add(std::min({corner[0], corner[1], corner[row], corner[row + 1]}));
      }
    }
    while (width_ > 1 || height_ > 1) build_next_level();
  }

 private:
  void start_level() {
    const auto level = static_cast<std::size_t>(field_.levels++);
    field_.first[level] = static_cast<std::int32_t>(field_.least.size());
    field_.width[level] = width_;
  }
  void add(float least) { field_.least.push_back(least); }

  void build_next_level() {
    const auto below = static_cast<std::size_t>(field_.first[static_cast<std::size_t>(field_.levels) - 1]);
    const int below_width = width_, below_height = height_;
    width_ = (width_ + 1) / 2;
    height_ = (height_ + 1) / 2;
    start_level();
    const auto at = [&](int i, int j) {
      const auto column = static_cast<std::size_t>(std::min(i, below_width - 1));
      const auto row = static_cast<std::size_t>(std::min(j, below_height - 1));
      return field_.least[below + row * static_cast<std::size_t>(below_width) + column];
    };
    for (int j = 0; j < height_; ++j) {
      for (int i = 0; i < width_; ++i) {
        add(std::min(
            {at(2 * i, 2 * j), at(2 * i + 1, 2 * j), at(2 * i, 2 * j + 1), at(2 * i + 1, 2 * j + 1)}));
      }
    }
  }

  ReliefField& field_;
  int width_, height_;
};

}  // namespace

ReliefField::ReliefField(const Image& picture, ReliefKind kind, const Sampler& wrap)
    : x(make_axis(picture.width(), wrap.wrap_u)), y(make_axis(picture.height(), wrap.wrap_v)) {
  const std::vector<int> columns = texels_of(x, picture.width()), rows = texels_of(y, picture.height());
  corners.reserve(columns.size() * rows.size());
  for (const int row : rows) {
    for (const int column : columns) {
      const float value = std::clamp(picture.value(column, row, 0), 0.0F, 1.0F);
      corners.push_back(kind == ReliefKind::height ? 1 - value : value);
    }
  }
  const std::size_t cells = static_cast<std::size_t>(x.cells) * static_cast<std::size_t>(y.cells);
  least.reserve(cells + cells / 2 + 64);
  PyramidBuilder(*this).build();
}

}  // namespace laterna::frame
