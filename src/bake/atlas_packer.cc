#include "bake/atlas_packer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

namespace laterna::bake {
namespace {

constexpr int kLeastSide = 16;

// What of a page is taken: everything below a line of steps.
class Skyline {
 public:
  explicit Skyline(int side) : side_(side), steps_{{0, 0, side}} {}

  /// Takes the lowest place for a rectangle, the leftmost of several.
  std::optional<glm::ivec2> take(glm::ivec2 size) {
    std::optional<glm::ivec2> best;
    for (std::size_t i = 0; i < steps_.size() && steps_[i].x + size.x <= side_; ++i) {
      const int y = height_over(i, size.x);
      if (y + size.y <= side_ && (!best || y < best->y)) best = glm::ivec2(steps_[i].x, y);
    }
    if (best) raise(best->x, size.x, best->y + size.y);
    return best;
  }

 private:
  struct Step {
    int x, y, width;
  };

  [[nodiscard]] int height_over(std::size_t first, int width) const {
    int y = 0;
    const int end = steps_[first].x + width;
    for (std::size_t i = first; i < steps_.size() && steps_[i].x < end; ++i) y = std::max(y, steps_[i].y);
    return y;
  }

  void raise(int x, int width, int y) {
    std::vector<Step> steps;
    const auto add = [&](Step step) {
      if (step.width <= 0) return;
      if (!steps.empty() && steps.back().y == step.y) {
        steps.back().width += step.width;
      } else {
        steps.push_back(step);
      }
    };
    bool is_placed = false;
    for (const Step& step : steps_) {
      const int end = step.x + step.width;
      add({step.x, step.y, std::min(end, x) - step.x});
      if (!is_placed && end > x) {
        add({x, y, width});
        is_placed = true;
      }
      const int from = std::max(step.x, x + width);
      add({from, step.y, end - from});
    }
    steps_ = std::move(steps);
  }

  int side_;
  std::vector<Step> steps_;
};

// On pages of one side; nothing where they would be more than `max_pages`. What is packed is larger by the gap, and so is
// the page: none is left over at its rim.
std::optional<PackedRectangles> pack_on(std::span<const glm::ivec2> sizes, std::span<const std::size_t> order,
                                        int gap, int side, std::size_t max_pages) {
  PackedRectangles packed;
  packed.places.resize(sizes.size());
  std::vector<Skyline> skylines;
  glm::ivec2 last_size(0);
  std::size_t page = 0;
  for (const std::size_t i : order) {
    std::optional<glm::ivec2> corner;
    // Where one had no place, the next of the same size has none.
    if (sizes[i] != last_size) page = 0;
    last_size = sizes[i];
    for (; !corner; ++page) {
      if (page == skylines.size()) {
        if (page == max_pages) return std::nullopt;
        skylines.emplace_back(side + gap);
        packed.pages.emplace_back(0);
      }
      corner = skylines[page].take(sizes[i] + gap);
    }
    --page;
    packed.places[i] = {page, *corner};
    glm::ivec2& size = packed.pages[page];
    size.x = std::max(size.x, corner->x + sizes[i].x);
    size.y = std::max(size.y, corner->y + sizes[i].y);
  }
  return packed;
}

}  // namespace

std::optional<PackedRectangles> pack_rectangles(std::span<const glm::ivec2> sizes, int gap, int max_side,
                                                std::size_t max_pages) {
  if (max_pages == 0) return std::nullopt;
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sizes[a].y != sizes[b].y ? sizes[a].y > sizes[b].y : sizes[a].x > sizes[b].x;
  });
  std::int64_t area = 0;
  for (const glm::ivec2& size : sizes) area += std::int64_t{size.x} * size.y;
  for (int side = std::min(kLeastSide, max_side); side < max_side; side = std::min(2 * side, max_side)) {
    if (std::int64_t{side} * side < area) continue;
    if (auto packed = pack_on(sizes, order, gap, side, 1)) return packed;
  }
  return pack_on(sizes, order, gap, max_side, max_pages);
}

}  // namespace laterna::bake
