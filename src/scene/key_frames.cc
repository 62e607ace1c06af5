#include "scene/key_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna {
namespace {

glm::dvec4 to_quaternion(std::span<const double> v) { return {v[0], v[1], v[2], v[3]}; }

void normalise(std::span<double> rotation) {
  const glm::dvec4 q = to_quaternion(rotation);
  const double length = std::sqrt(glm::dot(q, q));
  // A cubic may pass through 0 between opposite keys: any rotation is as good there.
  const glm::dvec4 unit = length > 0 ? q / length : glm::dvec4(0, 0, 0, 1);
  for (int i = 0; i < 4; ++i) rotation[static_cast<std::size_t>(i)] = unit[i];
}

// Two keys and what lies between them.
class Segment {
 public:
  Segment(const KeyFrames& keys, std::size_t first, double time, std::size_t components)
      : keys_(keys),
        first_(first),
        components_(components),
        length_(keys.times[first + 1] - keys.times[first]),
        t_(std::clamp((time - keys.times[first]) / length_, 0.0, 1.0)) {}

  void linear(std::span<double> values) const {
    for (std::size_t i = 0; i < components_; ++i) {
      const double a = keys_.values[first_ * components_ + i];
      const double b = keys_.values[(first_ + 1) * components_ + i];
      values[i] = a + (b - a) * t_;
    }
  }

  void rotation(std::span<double> values) const {
    const std::span<const double> all = keys_.values;
    const glm::dvec4 q =
        slerp(to_quaternion(all.subspan(4 * first_)), to_quaternion(all.subspan(4 * (first_ + 1))), t_);
    for (int i = 0; i < 4; ++i) values[static_cast<std::size_t>(i)] = q[i];
  }

  // glTF 2.0, appendix C.5.
  void cubic(std::span<double> values) const {
    const double t2 = t_ * t_, t3 = t2 * t_;
    const double of_from = 2 * t3 - 3 * t2 + 1, of_slope_from = t3 - 2 * t2 + t_;
    const double of_to = -2 * t3 + 3 * t2, of_slope_to = t3 - t2;
    const double* from = keys_.values.data() + 3 * components_ * first_;
    const double* to = from + 3 * components_;
    for (std::size_t i = 0; i < components_; ++i) {
      values[i] = of_from * from[components_ + i] + length_ * of_slope_from * from[2 * components_ + i] +
                  of_to * to[components_ + i] + length_ * of_slope_to * to[i];
    }
  }

 private:
  const KeyFrames& keys_;
  std::size_t first_, components_;
  double length_, t_;
};

void copy_key(const KeyFrames& keys, std::size_t key, std::span<double> values) {
  const bool has_slopes = keys.interpolation == KeyInterpolation::cubic_spline;
  const std::size_t at = has_slopes ? (3 * key + 1) * values.size() : key * values.size();
  std::copy_n(keys.values.begin() + static_cast<std::ptrdiff_t>(at), values.size(), values.begin());
}

}  // namespace

glm::dvec4 slerp(const glm::dvec4& a, glm::dvec4 b, double t) {
  if (glm::dot(a, b) < 0) b = -b;
  // Half the angle between them: exact for small angles too, where an arc cosine is not.
  const glm::dvec4 difference = b - a, sum = b + a;
  const double angle =
      2 * arctangent2(std::sqrt(glm::dot(difference, difference)), std::sqrt(glm::dot(sum, sum)));
  const double divisor = sine(angle);
  glm::dvec4 between = a + difference * t;  // nearer than rounding shows, a chord is an arc
  if (divisor > 1e-9) between = a * (sine((1 - t) * angle) / divisor) + b * (sine(t * angle) / divisor);
  return between / std::sqrt(glm::dot(between, between));
}

void sample_keys(const KeyFrames& keys, double time, bool is_rotation, std::span<double> values) {
  // A key counts as begun a little early, so that rounded times of pictures cannot miss a step.
  const auto after = std::upper_bound(keys.times.begin(), keys.times.end(), time + kSameInstant);
  const auto begun = static_cast<std::size_t>(after - keys.times.begin());
  if (begun == 0 || begun == keys.times.size() || keys.interpolation == KeyInterpolation::step) {
    copy_key(keys, begun == 0 ? 0 : begun - 1, values);
  } else {
    const Segment segment(keys, begun - 1, time, values.size());
    if (keys.interpolation == KeyInterpolation::cubic_spline) {
      segment.cubic(values);
    } else if (is_rotation) {
      segment.rotation(values);
    } else {
      segment.linear(values);
    }
  }
  if (is_rotation) normalise(values);
}

double clip_time(const Clip& clip, double duration, double scene_time) {
  if (!(duration > 0)) return 0;
  if (clip.at_end == AtEnd::loop || clip.at_end == AtEnd::ping_pong) {
    const double period = clip.at_end == AtEnd::loop ? duration : 2 * duration;
    double time = std::fmod(scene_time, period);  // exact in IEEE 754, unlike most of libm
    if (time < 0) time += period;
    return time > duration ? period - time : time;
  }
  return std::clamp(scene_time, 0.0, duration);
}

}  // namespace laterna
