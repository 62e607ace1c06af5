// The irregular z-buffer (Johnson et al. 2005, The irregular z-buffer; Aila and Laine 2004, Alias-free shadow maps)
// turned round: samples are not sorted into bins of the light's view, for they come in groups that are small there
// already. A batch of groups is one bundle of light. Triangles stream through it out of a tree: those that meet the
// bundle's shaft are held against the rectangles of all its groups at once, and then against the 16 samples of each
// group that they may darken. That last answer is one of signs, found in single precision with a bound on its error, and
// in double where the bound says that it may be wrong.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/exact_shadow.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/vectors-inl.h"
#include "frame/surface_alpha.h"
#include "raster/triangle_bins.h"
#include "shadow/exact_shadow.h"
#include "shadow/nearest_blocker.h"
#include "shadow/rough_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

static_assert(kTreeWidth == kGroupSize && kMaxGroups == kGroupSize);

// Packets that darkened what a thread asked about just before: its next samples are probably their neighbours, and what is
// dark soon needs no more looking. A guess only, which cannot be seen in any answer.
struct RecentPackets {
  static constexpr std::size_t kMost = 4, kLights = 16;
  std::array<std::uint32_t, kMost> packets;

  static RecentPackets& of(std::size_t light) {
    thread_local std::array<RecentPackets, kLights> recent{};
    return recent[light % kLights];
  }

  [[nodiscard]] bool contains(std::uint32_t index) const {
    return std::find(packets.begin(), packets.end(), index) != packets.end();
  }
  // The latest first.
  void note(std::uint32_t index) {
    auto place = std::find(packets.begin(), packets.end() - 1, index);
    std::rotate(packets.begin(), place, place + 1);
    packets[0] = index;
  }
};

template <bool kParallel>
class BatchTest {
 public:
  /// With `panes`, triangles darken nothing: where they are crossed is noted.
  BatchTest(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit,
            std::vector<PaneCrossing>* panes)
      : test_(test), samples_(samples), lit_(lit), panes_(panes) {}

  void Run() {
    Bundle bundle;
    for (std::size_t group = 0; group < samples_.group_count; ++group) {
      if (lit_[group] != 0) bundle.group[bundle.count++] = static_cast<std::uint8_t>(group);
    }
    if (bundle.count > 0) Darken(bundle);
  }

 private:
  void Darken(Bundle& bundle) {
    Place(bundle);
    if (!bundle.is_sound) {
      DarkenApart(bundle);
      return;
    }
    if (bundle.count > 1 && IsScattered(bundle)) {
      Bundle parts[2];
      const bool is_wide = bundle.high_x - bundle.low_x >= bundle.high_y - bundle.low_y;
      const float* places = is_wide ? bundle.x : bundle.y;
      const float middle =
          is_wide ? 0.5F * (bundle.low_x + bundle.high_x) : 0.5F * (bundle.low_y + bundle.high_y);
      for (std::size_t i = 0; i < bundle.count; ++i) {
        Bundle& part = parts[places[i] < middle ? 0 : 1];
        part.group[part.count++] = bundle.group[i];
      }
      if (parts[0].count > 0 && parts[1].count > 0) {
        Darken(parts[0]);
        Darken(parts[1]);
        return;
      }
    }
    Stream(bundle);
  }

  // The groups fill little of the bundle.
  [[nodiscard]] static bool IsScattered(const Bundle& bundle) {
    float filled = 0;
    for (std::size_t i = 0; i < bundle.count; ++i) filled += bundle.half_x[i] * bundle.half_y[i];
    return (bundle.high_x - bundle.low_x) * (bundle.high_y - bundle.low_y) > 4 * kSpread * filled;
  }
  static constexpr float kSpread = 4;

  // Around the light, where no one view shows all: group by group, and then sample by sample.
  void DarkenApart(const Bundle& bundle) {
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const std::size_t group = bundle.group[i];
      Bundle single;
      single.count = 1;
      single.group[0] = bundle.group[i];
      if (bundle.count > 1) {
        Darken(single);
        continue;
      }
      const std::uint32_t all = lit_[group];
      if ((all & (all - 1)) == 0) return;  // a sample at the light itself, which is lit
      std::uint32_t still_lit = 0;
      for (std::uint32_t left = all; left != 0; left &= left - 1) {
        lit_[group] = static_cast<std::uint16_t>(left & (~left + 1));
        single.count = 1;
        Darken(single);
        still_lit |= lit_[group];
      }
      lit_[group] = static_cast<std::uint16_t>(still_lit);
    }
  }

  // ------------------------------------------------------------------------------------------ placing

  void Place(Bundle& bundle) {
    const float* coordinates[3] = {samples_.x_ws.data(), samples_.y_ws.data(), samples_.z_ws.data()};
    Extremes bounds[3][kMaxGroups];
    for (int k = 0; k < 3; ++k) {
      Extremes all = {3e38F, -3e38F};
      for (std::size_t i = 0; i < bundle.count; ++i) {
        const std::size_t group = bundle.group[i];
        bounds[k][i] = ExtremesOf(coordinates[k] + group * kGroupSize, lit_[group]);
        all = {std::min(all.low, bounds[k][i].low), std::max(all.high, bounds[k][i].high)};
      }
      // In single precision, so that differences from it round only once.
      const float middle = 0.5F * all.low + 0.5F * all.high;
      bundle.centre_ws[k] = middle;
      bundle.half[k] = std::max(all.high - middle, middle - all.low);
    }
    if constexpr (kParallel) {
      bundle.axes = Axes::along(test_.light.forward_ws);
      const glm::dvec3 along = bundle.axes.of(test_.light.forward_ws);
      bundle.centre = glm::dvec3(0);
      bundle.middle_x = along.x / along.z, bundle.middle_y = along.y / along.z;
    } else {
      const glm::dvec3 from_light = bundle.centre_ws - test_.light.position_ws;
      bundle.axes = Axes::along(from_light);
      bundle.centre = bundle.axes.of(from_light);
      bundle.is_sound = bundle.centre.z > 0;
      if (!bundle.is_sound) return;
      bundle.middle_x = bundle.centre.x / bundle.centre.z,
      bundle.middle_y = bundle.centre.y / bundle.centre.z;
    }
    bundle.alive = (1U << bundle.count) - 1;
    PlaceBoxes(bundle, bounds);
    PlaceGroups(bundle);
  }

  static void PlaceBoxes(Bundle& bundle, const Extremes bounds[3][kMaxGroups]) {
    const int order[3] = {bundle.axes.x, bundle.axes.y, bundle.axes.w};
    const glm::vec3 half(bundle.half[0], bundle.half[1], bundle.half[2]);
    bundle.half_of_all = 0;
    for (int k = 0; k < 3; ++k) {
      const Extremes* along = bounds[order[k]];
      const auto centre = static_cast<float>(bundle.centre_ws[order[k]]);
      const float sign = k == 2 ? static_cast<float>(bundle.axes.sign) : 1.0F;
      bundle.half[k] = 1.00001F * half[order[k]];
      bundle.half_of_all = std::max(bundle.half_of_all, bundle.half[k]);
      for (std::size_t i = 0; i < kMaxGroups; ++i) {
        const bool is_used = i < bundle.count;
        const float low = is_used ? along[i].low - centre : 0, high = is_used ? along[i].high - centre : 0;
        bundle.box[k][i] = sign * 0.5F * (low + high);
        bundle.half_box[k][i] = 0.500001F * (high - low) + 2e-7F * (std::abs(low) + std::abs(high));
      }
    }
  }

  void PlaceGroups(Bundle& bundle) {
    constexpr float kWidest = 8;
    Extremes all_x = {3e38F, -3e38F}, all_y = all_x, all_w = all_x;
    bundle.nearest_of_all = 3e38F;
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const std::size_t group = bundle.group[i];
      PlaceSamples(bundle, group * kGroupSize);
      const Extremes x = ExtremesOf(view_.x.data() + group * kGroupSize, lit_[group]);
      const Extremes y = ExtremesOf(view_.y.data() + group * kGroupSize, lit_[group]);
      const Extremes w = ExtremesOf(w_.data(), lit_[group]);
      bundle.x[i] = 0.5F * (x.low + x.high), bundle.y[i] = 0.5F * (y.low + y.high);
      // Half and a little, for the rounding of the middle.
      bundle.half_x[i] = 0.500001F * (x.high - x.low) + 1e-7F * std::abs(bundle.x[i]);
      bundle.half_y[i] = 0.500001F * (y.high - y.low) + 1e-7F * std::abs(bundle.y[i]);
      bundle.deepest[i] = w.high;
      const float nearest = ExtremesOf(near_.data(), lit_[group]).low;
      bundle.nearest[i] = kParallel ? nearest : nearest / w.high;
      bundle.nearest_of_all = std::min(bundle.nearest_of_all, bundle.nearest[i]);
      all_x = {std::min(all_x.low, x.low), std::max(all_x.high, x.high)};
      all_y = {std::min(all_y.low, y.low), std::max(all_y.high, y.high)};
      all_w = {std::min(all_w.low, w.low), std::max(all_w.high, w.high)};
    }
    for (std::size_t i = bundle.count; i < kMaxGroups; ++i) {
      bundle.x[i] = bundle.y[i] = bundle.half_x[i] = bundle.half_y[i] = bundle.nearest[i] = 0;
      bundle.deepest[i] = 0;
    }
    bundle.low_x = all_x.low, bundle.high_x = all_x.high, bundle.low_y = all_y.low,
    bundle.high_y = all_y.high;
    bundle.reach_x = 1.001F * std::max(std::abs(all_x.low), std::abs(all_x.high));
    bundle.reach_y = 1.001F * std::max(std::abs(all_y.low), std::abs(all_y.high));
    bundle.farthest = 1.001F * std::max(std::abs(all_w.low), std::abs(all_w.high));
    bundle.deepest_of_all = all_w.high;
    // Written so that what is no number is not sound either.
    bundle.is_sound = kParallel || (all_w.low > 0 && all_x.low > -kWidest && all_x.high < kWidest &&
                                    all_y.low > -kWidest && all_y.high < kWidest);
  }

  // A group's samples in the light's view. Loops over 16 lanes, which compilers make vectors of.
  void PlaceSamples(const Bundle& bundle, std::size_t first) {
    const float* coordinates[3] = {samples_.x_ws.data() + first, samples_.y_ws.data() + first,
                                   samples_.z_ws.data() + first};
    const float* xs = coordinates[bundle.axes.x];
    const float* ys = coordinates[bundle.axes.y];
    const float* ws = coordinates[bundle.axes.w];
    const glm::dvec3 origin_ws = kParallel ? bundle.centre_ws : test_.light.position_ws;
    const double origin_x = origin_ws[bundle.axes.x], origin_y = origin_ws[bundle.axes.y],
                 origin_w = origin_ws[bundle.axes.w];
    const double sign = bundle.axes.sign, middle_x = bundle.middle_x, middle_y = bundle.middle_y;
    float* x_out = view_.x.data() + first;
    float* y_out = view_.y.data() + first;
    float* w_out = w_.data();
    for (std::size_t i = 0; i < kGroupSize; ++i) {
      const double x = xs[i] - origin_x, y = ys[i] - origin_y, w = sign * (ws[i] - origin_w);
      if constexpr (kParallel) {
        x_out[i] = static_cast<float>(x - middle_x * w);
        y_out[i] = static_cast<float>(y - middle_y * w);
      } else {
        const double inverse = 1 / w;
        x_out[i] = static_cast<float>(x * inverse - middle_x);
        y_out[i] = static_cast<float>(y * inverse - middle_y);
      }
      w_out[i] = static_cast<float>(w);
    }
    FindDepths(bundle, first);
  }

  // nearest_blocker() in single precision, with what it may be wrong by, taken off the samples' depth.
  void FindDepths(const Bundle& bundle, std::size_t first) {
    const FloatTag d;
    const raster::RasterView::Ray& ray = samples_.ray;
    const auto splat = [](double value) HWY_ATTR { return Splat(static_cast<float>(value)); };
    for (std::size_t i = first; i < first + kGroupSize; i += kLanes) {
      const auto load = [&](const SampleArray<float>& values)
                            HWY_ATTR { return hn::Load(d, values.data() + i); };
      const Vector3 p = {load(samples_.x_ws), load(samples_.y_ws), load(samples_.z_ws)};
      const auto h = splat(ray.ray_0.w) + splat(ray.ray_x.w) * load(samples_.x) +
                     splat(ray.ray_y.w) * load(samples_.y) + splat(ray.q_term.w) * load(samples_.q);
      const auto reach = hn::Abs(p.x) + hn::Abs(p.y) + hn::Abs(p.z);
      auto pixel = Splat(0.0F), doubt = Splat(0.0F);
      const auto add_side = [&](const glm::dvec4& along, FloatVector dq) HWY_ATTR {
        const auto step_w = splat(along.w) + splat(ray.q_term.w) * dq;
        const Vector3 step = {splat(along.x) + splat(ray.q_term.x) * dq,
                              splat(along.y) + splat(ray.q_term.y) * dq,
                              splat(along.z) + splat(ray.q_term.z) * dq};
        const Vector3 side = step - p * step_w;
        pixel = pixel + hn::Sqrt(Dot(side, side));
        doubt = doubt + hn::Abs(step.x) + hn::Abs(step.y) + hn::Abs(step.z) + hn::Abs(step_w) * reach;
      };
      add_side(ray.ray_x, load(samples_.dq_dx));
      add_side(ray.ray_y, load(samples_.dq_dy));
      const auto per_subpixel = Splat(1.0F / raster::kSubpixels) / h;
      const auto near = Splat(2 * samples_.position_error) + pixel * per_subpixel;
      const auto wrong = near * Splat(1e-4F) + doubt * per_subpixel * Splat(kSingleError);
      // Along w: what is along the way to the light.
      FloatVector share;
      if constexpr (kParallel) {
        share = splat(std::abs(test_.light.forward_ws[bundle.axes.w]));
      } else {
        const auto x = load(view_.x) + splat(bundle.middle_x), y = load(view_.y) + splat(bundle.middle_y);
        share = Splat(1.0F) / hn::Sqrt(x * x + y * y + Splat(1.0F));
      }
      const auto w = hn::Load(d, w_.data() + (i - first));
      const auto least = hn::Max(near - wrong, Splat(0.0F));
      hn::Store(w - (near + wrong) * share, d, view_.far_sure.data() + i);
      const auto least_along = least * share * Splat(1 - 1e-6F);
      hn::Store(least_along, d, near_.data() + (i - first));
      hn::Store(w - least_along, d, view_.far_most.data() + i);
    }
  }

  // ------------------------------------------------------------------------------------------ streaming

  [[nodiscard]] Shaft ShaftOf(const Bundle& bundle) const {
    const Axes& axes = bundle.axes;
    const glm::dvec3 origin_ws = kParallel ? bundle.centre_ws : test_.light.position_ws;
    const glm::dvec3 origin = {origin_ws[axes.x], origin_ws[axes.y], origin_ws[axes.w]};
    // What rounding does to x − k w, with the origin's own: of numbers no larger than this. |k| ≤ 9.
    const double extent = 2 * (static_cast<double>(test_.tree->extent()) + Size(origin_ws));
    const double slope = kParallel ? 1.0
                                   : 1 + std::max(std::abs(bundle.middle_x) + bundle.reach_x,
                                                  std::abs(bundle.middle_y) + bundle.reach_y);
    const auto margin = static_cast<float>(kSingleError * extent * (1 + slope));
    Shaft shaft;
    for (int k = 0; k < 3; ++k) shaft.origin[k] = static_cast<float>(origin[k]);
    shaft.is_turned = axes.sign < 0;
    const auto middle_x = static_cast<float>(bundle.middle_x), middle_y = static_cast<float>(bundle.middle_y);
    if constexpr (kParallel) {
      shaft.x_low = {middle_x, bundle.low_x - margin}, shaft.x_high = {middle_x, bundle.high_x + margin};
      shaft.y_low = {middle_y, bundle.low_y - margin}, shaft.y_high = {middle_y, bundle.high_y + margin};
      shaft.w_low = -3e38F;
    } else {
      shaft.x_low = {middle_x + bundle.low_x, -margin}, shaft.x_high = {middle_x + bundle.high_x, margin};
      shaft.y_low = {middle_y + bundle.low_y, -margin}, shaft.y_high = {middle_y + bundle.high_y, margin};
      shaft.w_low = -margin;
    }
    shaft.w_high = bundle.deepest_of_all + margin;
    shaft.margin = margin;
    return shaft;
  }

  // Children of a node whose boxes meet the shaft.
  static std::uint32_t ChildrenIn(const Shaft& shaft, const Axes& axes, const CasterNode& node) {
    const FloatTag d;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kTreeWidth; k += kLanes) {
      const auto low_x = hn::Load(d, node.low[axes.x] + k) - Splat(shaft.origin[0]);
      const auto high_x = hn::Load(d, node.high[axes.x] + k) - Splat(shaft.origin[0]);
      const auto low_y = hn::Load(d, node.low[axes.y] + k) - Splat(shaft.origin[1]);
      const auto high_y = hn::Load(d, node.high[axes.y] + k) - Splat(shaft.origin[1]);
      auto low_w = hn::Load(d, node.low[axes.w] + k) - Splat(shaft.origin[2]);
      auto high_w = hn::Load(d, node.high[axes.w] + k) - Splat(shaft.origin[2]);
      if (shaft.is_turned) {
        const auto turned = Splat(0.0F) - low_w;
        low_w = Splat(0.0F) - high_w;
        high_w = turned;
      }
      const auto least = [&](FloatVector low, const Side& side) HWY_ATTR {
        return low - Splat(side.k) * (side.k > 0 ? high_w : low_w) <= Splat(side.c);
      };
      const auto most = [&](FloatVector high, const Side& side) HWY_ATTR {
        return high - Splat(side.k) * (side.k > 0 ? low_w : high_w) >= Splat(side.c);
      };
      auto meets = hn::And(low_w <= Splat(shaft.w_high), high_w >= Splat(shaft.w_low));
      meets = hn::And(meets, hn::And(least(low_x, shaft.x_high), most(high_x, shaft.x_low)));
      meets = hn::And(meets, hn::And(least(low_y, shaft.y_high), most(high_y, shaft.y_low)));
      bits |= BitsOf(meets) << k;
    }
    return bits;
  }

  // Groups that what is in a box may darken.
  static std::uint32_t GroupsBehindBox(const Shaft& shaft, const Bundle& bundle, const CasterNode& node,
                                       std::size_t child) {
    const FloatTag d;
    const Axes& axes = bundle.axes;
    const float low_x = node.low[axes.x][child] - shaft.origin[0],
                high_x = node.high[axes.x][child] - shaft.origin[0];
    const float low_y = node.low[axes.y][child] - shaft.origin[1],
                high_y = node.high[axes.y][child] - shaft.origin[1];
    float low_w = node.low[axes.w][child] - shaft.origin[2],
          high_w = node.high[axes.w][child] - shaft.origin[2];
    if (shaft.is_turned) {
      std::swap(low_w, high_w);
      low_w = -low_w, high_w = -high_w;
    }
    const auto margin = Splat(shaft.margin);
    const auto meets = [&](float low, float high, float middle, const float* at, const float* half,
                           std::size_t g) HWY_ATTR {
      const auto place = hn::Load(d, at + g), reach = hn::Load(d, half + g);
      if constexpr (kParallel) {
        const float slid[2] = {middle * low_w, middle * high_w};
        return hn::And(Splat(low - std::max(slid[0], slid[1])) <= place + reach + margin,
                       Splat(high - std::min(slid[0], slid[1])) >= place - reach - margin);
      } else {
        const auto k_low = Splat(middle) + (place - reach), k_high = Splat(middle) + (place + reach);
        const auto w_low = Splat(low_w), w_high = Splat(high_w);
        return hn::And(Splat(low) - hn::Max(k_high * w_low, k_high * w_high) <= margin,
                       Splat(high) - hn::Min(k_low * w_low, k_low * w_high) >= Splat(-shaft.margin));
      }
    };
    std::uint32_t bits = 0;
    for (std::size_t g = 0; g < bundle.count; g += kLanes) {
      auto may = Splat(low_w) <= hn::Load(d, bundle.deepest + g) + margin;
      may =
          hn::And(may, meets(low_x, high_x, static_cast<float>(bundle.middle_x), bundle.x, bundle.half_x, g));
      may =
          hn::And(may, meets(low_y, high_y, static_cast<float>(bundle.middle_y), bundle.y, bundle.half_y, g));
      bits |= BitsOf(may) << g;
    }
    return bits & bundle.alive;
  }

  // Triangles of a packet that may darken some of the bundle, set up in rough_.
  std::uint32_t TrianglesIn(const Bundle& bundle, const CasterPacket& packet) {
    const FloatTag d;
    const Axes& axes = bundle.axes;
    const auto origin_x = Splat(static_cast<float>(bundle.centre_ws[axes.x])),
               origin_y = Splat(static_cast<float>(bundle.centre_ws[axes.y])),
               origin_w = Splat(static_cast<float>(bundle.centre_ws[axes.w])),
               sign = Splat(static_cast<float>(axes.sign));
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < packet.count; k += kLanes) {
      Vector3 corner[3];
      for (int i = 0; i < 3; ++i) {
        const auto& at = packet.corner[i];
        corner[i] = {hn::Load(d, at[axes.x] + k) - origin_x, hn::Load(d, at[axes.y] + k) - origin_y,
                     (hn::Load(d, at[axes.w] + k) - origin_w) * sign};
      }
      bits |= SetUpRough<kParallel>(bundle, corner, k, rough_) << k;
    }
    return bits & ((1U << packet.count) - 1);
  }

  void Stream(Bundle& bundle) {
    const Shaft shaft = ShaftOf(bundle);
    RecentPackets& recent = RecentPackets::of(test_.number);
    const RecentPackets first = recent;
    for (const std::uint32_t index : first.packets) {
      // Through panes nothing is dark soon, and each is looked for once.
      if (panes_ == nullptr && index < test_.tree->packet_count()) {
        StreamPacket(bundle, index, bundle.alive, recent);
      }
    }
    if (bundle.alive == 0) return;
    std::uint32_t ahead[kMostNodesAhead];
    std::size_t count = 0;
    ahead[count++] = 0;
    while (count > 0) {
      const CasterNode& node = test_.tree->nodes()[ahead[--count]];
      for (std::uint32_t left = ChildrenIn(shaft, bundle.axes, node); left != 0; left &= left - 1) {
        const auto place = static_cast<std::size_t>(__builtin_ctz(left));
        const std::uint32_t child = node.child[place];
        if ((child & kIsPacket) == 0) {
          ahead[count++] = child;
        } else if (const std::uint32_t index = child & ~kIsPacket;
                   panes_ != nullptr || !first.contains(index)) {
          const std::uint32_t groups = GroupsBehindBox(shaft, bundle, node, place);
          if (groups == 0) continue;
          StreamPacket(bundle, index, groups, recent);
          if (bundle.alive == 0) return;
        }
      }
    }
  }

  // Of `groups`. Whichever are fewer, triangles or groups, are taken one by one, and the others 16 at a time.
  void StreamPacket(Bundle& bundle, std::uint32_t index, std::uint32_t groups, RecentPackets& recent) {
    const CasterPacket& packet = test_.tree->packets()[index];
    const std::uint32_t triangles = TrianglesIn(bundle, packet);
    bool has_darkened = false;
    if (__builtin_popcount(groups) < __builtin_popcount(triangles)) {
      for (; groups != 0; groups &= groups - 1) {
        const auto slot = static_cast<std::size_t>(__builtin_ctz(groups));
        for (std::uint32_t left = TrianglesBefore(bundle, slot, rough_) & triangles; left != 0;
             left &= left - 1) {
          has_darkened |= DarkenBy(bundle, packet, static_cast<std::size_t>(__builtin_ctz(left)), 1U << slot);
        }
      }
    } else {
      for (std::uint32_t left = triangles; left != 0; left &= left - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
        has_darkened |= DarkenBy(bundle, packet, lane, GroupsBehind(bundle, rough_, lane) & groups);
      }
    }
    if (has_darkened) recent.note(index);
  }

  // Returns whether it darkens any sample.
  bool DarkenBy(Bundle& bundle, const CasterPacket& packet, std::size_t lane, std::uint32_t groups) {
    const TriangleId id = packet.id[lane];
    bool is_set_up = false;
    Candidate candidate;
    bool has_darkened = false;
    for (groups &= bundle.alive; groups != 0; groups &= groups - 1) {
      const int slot = __builtin_ctz(groups);
      const std::size_t group = bundle.group[slot];
      const std::size_t first = group * kGroupSize;
      const std::uint32_t behind =
          SamplesBehind(view_, samples_.id.data(), first, rough_, lane, id) & lit_[group];
      if (behind == 0) continue;
      if (!is_set_up && !SetUp(bundle, packet, lane, candidate)) return false;
      is_set_up = true;
      const std::uint32_t dark = DarkSamples(candidate, first, behind);
      has_darkened |= dark != 0;
      lit_[group] = static_cast<std::uint16_t>(lit_[group] & ~dark);
      if (lit_[group] == 0) bundle.alive &= ~(1U << slot);
    }
    return has_darkened;
  }

  // A triangle that some sample may lie behind.
  struct Candidate {
    TriangleId id;
    CornersOfTriangle at;
    EdgeFunctions edges;
    bool needs_double;
  };

  // False where the light sees it edge-on.
  bool SetUp(const Bundle& bundle, const CasterPacket& packet, std::size_t lane, Candidate& candidate) const {
    const auto corner_ws = [&](int k) HWY_ATTR {
      return glm::vec3(packet.corner[k][0][lane], packet.corner[k][1][lane], packet.corner[k][2][lane]);
    };
    candidate.id = packet.id[lane];
    candidate.at = {corner_ws(0), corner_ws(1), corner_ws(2)};
    candidate.needs_double = panes_ != nullptr || HasHoles(candidate.id) || MayBeBeforeLight(candidate.at);
    const auto from_middle = [&](const glm::vec3& p)
                                 HWY_ATTR { return bundle.axes.of(glm::dvec3(p) - bundle.centre_ws); };
    const Corners corners = {from_middle(candidate.at.a), from_middle(candidate.at.b),
                             from_middle(candidate.at.c)};
    return kParallel ? SetUpParallel(bundle, corners, candidate.edges)
                     : SetUpPerspective(bundle, corners, candidate.edges);
  }

  // Those of the group's samples in `asked` that it darkens.
  [[nodiscard]] std::uint32_t DarkSamples(const Candidate& candidate, std::size_t first,
                                          std::uint32_t asked) const {
    Verdict verdict = TestSamples(view_, first, candidate.edges);
    if (candidate.needs_double) verdict.sure = 0;
    verdict.possible &= asked;
    std::uint32_t dark = verdict.possible & verdict.sure;
    for (std::uint32_t left = verdict.possible & ~verdict.sure; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      if (IsDarkened(first + static_cast<std::size_t>(i), candidate.at, candidate.id)) dark |= 1U << i;
    }
    return dark;
  }

  // ------------------------------------------------------------------------------------------ what is decided in double

  [[nodiscard]] bool HasHoles(TriangleId id) const {
    return (test_.frame->clusters[cluster_of(id)].flags & kAlphaMask) != 0;
  }

  // Whether some of it may lie before the light's near plane.
  [[nodiscard]] bool MayBeBeforeLight(const CornersOfTriangle& t) const {
    const light::LightRays& light = test_.light;
    if (!light.has_near) return false;
    const auto along = [&](const glm::vec3& p)
                           HWY_ATTR { return glm::dot(glm::dvec3(p) - light.position_ws, light.forward_ws); };
    return std::min({along(t.a), along(t.b), along(t.c)}) <
           light.near * (1 + 1e-9) + 1e-9 * test_.tree->extent();
  }

  [[nodiscard]] bool IsDarkened(std::size_t i, const CornersOfTriangle& triangle, TriangleId id) const {
    const glm::vec3 position(samples_.x_ws[i], samples_.y_ws[i], samples_.z_ws[i]);
    const OnEdge on_edge = panes_ == nullptr ? OnEdge::of_both : OnEdge::of_one;
    const Crossing crossing =
        find_crossing(test_.light, position, nearest_blocker(samples_, i), triangle, on_edge);
    if (!crossing.blocks) return false;
    if (panes_ != nullptr) {
      panes_->push_back({static_cast<std::uint32_t>(i), id, crossing.b, crossing.c});
      return false;
    }
    return !frame::is_hole(*test_.frame, id, crossing.b, crossing.c);
  }

  const ExactShadowTest& test_;
  const SurfaceSamples& samples_;
  std::span<std::uint16_t> lit_;
  std::vector<PaneCrossing>* panes_;
  SampleView view_;
  alignas(64) std::array<float, kGroupSize> w_, near_;  // of the group being placed
  RoughTriangles rough_;
};

void Run(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit,
         std::vector<PaneCrossing>* panes) {
  if (test.tree->is_empty()) return;
  if (test.light.is_parallel) {
    BatchTest<true>(test, samples, lit, panes).Run();
  } else {
    BatchTest<false>(test, samples, lit, panes).Run();
  }
}

void keep_lit(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit) {
  Run(test, samples, lit, nullptr);
}

void find_panes(const ExactShadowTest& test, const SurfaceSamples& samples,
                std::span<const std::uint16_t> wanted, std::vector<PaneCrossing>& crossings) {
  std::array<std::uint16_t, kMaxGroups> lit{};
  std::copy(wanted.begin(), wanted.end(), lit.begin());
  Run(test, samples, std::span(lit).first(wanted.size()), &crossings);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(keep_lit)
LATERNA_KERNEL_TABLE(find_panes)
}  // namespace laterna::shadow
#endif
