#include "shadow/caster_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace laterna::shadow {
namespace {

struct Box {
  std::array<float, 3> low, high;

  static Box nothing() {
    constexpr float kFar = std::numeric_limits<float>::max();
    return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  }
  void include(const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  // Half of it. In double: boxes are as large as coordinates may be.
  [[nodiscard]] double area() const {
    const double x = double{high[0]} - low[0], y = double{high[1]} - low[1], z = double{high[2]} - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

struct Caster {
  Box box;
  TriangleId id;
  // Twice the box's middle.
  [[nodiscard]] float middle(std::size_t axis) const { return box.low[axis] + box.high[axis]; }
};

struct Range {
  std::size_t first, end;
  int depth;  // splits above it
  [[nodiscard]] std::size_t count() const { return end - first; }
};

constexpr std::size_t kBins = 16;
// Deeper than this, ranges are halved, so that a tree has few levels whatever the triangles are: no more than these and
// the 27 halvings of 2³¹ triangles (kMostNodesAhead).
constexpr int kDeepestSurvey = 60;

}  // namespace

// Splits at the cheapest of 16 places along the longest side, by the surface area heuristic (Wald 2007, On fast
// construction of SAH-based bounding volume hierarchies), with packets counted in place of triangles. Four levels of
// splits make one node.
class CasterTree::Builder {
 public:
  Builder(const frame::Frame& frame, CasterTree& tree) : frame_(frame), tree_(tree) {}

  void add(Casters casters, std::uint32_t mask, std::uint32_t flags) {
    const auto is_asked_for = casters == Casters::blended ? is_blended_caster : is_opaque_caster;
    for (std::uint32_t c = 0; c < frame_.clusters.size(); ++c) {
      const Cluster& cluster = frame_.clusters[c];
      if (!is_asked_for(cluster) || (cluster.flags & mask) != flags) continue;
      for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) add(c << kTriangleBits | t);
    }
  }

  void build() {
    if (casters_.empty()) return;
    tree_.nodes_.resize(1);
    fill_node(0, {0, casters_.size(), 0});
    for (const Caster& caster : casters_) {
      for (std::size_t k = 0; k < 3; ++k)
        tree_.extent_ = std::max({tree_.extent_, std::abs(caster.box.low[k]), std::abs(caster.box.high[k])});
    }
  }

 private:
  [[nodiscard]] std::array<float, 3> corner(TriangleId id, std::uint32_t k) const {
    const glm::vec3 at = frame_.corner_ws(id, k);
    return {at.x, at.y, at.z};
  }

  void add(TriangleId id) {
    Caster caster = {Box::nothing(), id};
    for (std::uint32_t k = 0; k < 3; ++k) caster.box.include({corner(id, k), corner(id, k)});
    casters_.push_back(caster);
  }

  [[nodiscard]] Box box_of(const Range& range) const {
    Box box = Box::nothing();
    for (std::size_t i = range.first; i < range.end; ++i) box.include(casters_[i].box);
    return box;
  }

  void fill_node(std::size_t index, const Range& range) {
    std::array<Range, kTreeWidth> parts{range};
    std::size_t count = 1;
    // The largest part that is more than one packet is split until there are 16.
    while (count < kTreeWidth) {
      std::size_t largest = 0;
      for (std::size_t i = 1; i < count; ++i) {
        if (parts[i].count() > parts[largest].count()) largest = i;
      }
      if (parts[largest].count() <= kTreeWidth) break;
      const Range whole = parts[largest];
      const std::size_t middle = split(whole);
      parts[largest] = {whole.first, middle, whole.depth + 1};
      parts[count++] = {middle, whole.end, whole.depth + 1};
    }
    std::array<std::uint32_t, kTreeWidth> children{};
    for (std::size_t i = 0; i < count; ++i) {
      if (parts[i].count() <= kTreeWidth) {
        children[i] = add_packet(parts[i]) | kIsPacket;
      } else {
        children[i] = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.resize(tree_.nodes_.size() + 1);
        fill_node(children[i], parts[i]);
      }
    }
    CasterNode& node = tree_.nodes_[index];
    for (std::size_t i = 0; i < kTreeWidth; ++i) {
      const Box box = i < count ? box_of(parts[i]) : Box::nothing();
      for (std::size_t k = 0; k < 3; ++k) {
        node.low[k][i] = box.low[k];
        node.high[k][i] = box.high[k];
      }
      node.child[i] = children[i];
    }
  }

  std::uint32_t add_packet(const Range& range) {
    const std::size_t index = tree_.packets_.size();
    tree_.packets_.resize(index + 1);
    CasterPacket& packet = tree_.packets_[index];
    packet.count = static_cast<std::uint32_t>(range.count());
    for (std::size_t i = 0; i < kTreeWidth; ++i) {
      const TriangleId id = casters_[std::min(range.first + i, range.end - 1)].id;
      packet.id[i] = id;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::array<float, 3> at = corner(id, k);
        for (std::size_t axis = 0; axis < 3; ++axis) packet.corner[k][axis][i] = at[axis];
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  // Puts the range's casters in order about a place, and returns it.
  std::size_t split(const Range& range) {
    const auto first = casters_.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto end = casters_.begin() + static_cast<std::ptrdiff_t>(range.end);
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (auto caster = first; caster != end; ++caster) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], caster->middle(k));
        high[k] = std::max(high[k], caster->middle(k));
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    if (range.depth < kDeepestSurvey && high[axis] - low[axis] > 1e-30F) {
      const float scale = static_cast<float>(kBins) / (high[axis] - low[axis]);
      const auto bin_of = [&](const Caster& caster) {
        return std::min(static_cast<std::size_t>((caster.middle(axis) - low[axis]) * scale), kBins - 1);
      };
      if (const std::size_t place = cheapest_place(range, bin_of); place != 0) {
        const auto middle =
            std::partition(first, end, [&](const Caster& caster) { return bin_of(caster) < place; });
        return static_cast<std::size_t>(middle - casters_.begin());
      }
    }
    // Whole packets, so that halves of what cannot be told apart stay full.
    const std::size_t packets = (range.count() + kTreeWidth - 1) / kTreeWidth;
    const std::size_t middle = range.first + packets / 2 * kTreeWidth;
    std::nth_element(first, casters_.begin() + static_cast<std::ptrdiff_t>(middle), end,
                     [axis](const Caster& a, const Caster& b) { return a.middle(axis) < b.middle(axis); });
    return middle;
  }

  // The first bin on the right, or 0 where all casters fall into one.
  template <class BinOf>
  [[nodiscard]] std::size_t cheapest_place(const Range& range, const BinOf& bin_of) const {
    std::array<Box, kBins> boxes;
    boxes.fill(Box::nothing());
    std::array<std::size_t, kBins> counts{};
    for (std::size_t i = range.first; i < range.end; ++i) {
      const std::size_t bin = bin_of(casters_[i]);
      boxes[bin].include(casters_[i].box);
      ++counts[bin];
    }
    const auto cost = [](const Box& box, std::size_t count) {
      const std::size_t packets = (count + kTreeWidth - 1) / kTreeWidth;
      return box.area() * static_cast<double>(packets);
    };
    std::array<double, kBins> right_cost{};
    Box right = Box::nothing();
    std::size_t right_count = 0;
    for (std::size_t place = kBins - 1; place > 0; --place) {
      right.include(boxes[place]);
      right_count += counts[place];
      right_cost[place] = cost(right, right_count);
    }
    Box left = Box::nothing();
    std::size_t left_count = 0, best = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    for (std::size_t place = 1; place < kBins; ++place) {
      left.include(boxes[place - 1]);
      left_count += counts[place - 1];
      if (left_count == 0 || left_count == range.count()) continue;
      const double here = cost(left, left_count) + right_cost[place];
      if (here < best_cost) best_cost = here, best = place;
    }
    return best;
  }

  const frame::Frame& frame_;
  CasterTree& tree_;
  std::vector<Caster> casters_;
};

CasterTree::CasterTree(const frame::Frame& frame, Casters casters, std::uint32_t mask, std::uint32_t flags) {
  Builder builder(frame, *this);
  builder.add(casters, mask, flags);
  builder.build();
}

}  // namespace laterna::shadow
