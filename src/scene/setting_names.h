// How the settings of lights, lenses and shadows are spelled: one table for the files that hold them.
#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace laterna {

/// Readers ask for settings by the names that rigs have for them. A rig spells them so; the glTF extensions LATERNA_projector
/// and LATERNA_lighting as glTF does ("lens_shift" is lensShift, "near" is znear), words among the values likewise
/// ("flat_field" is flatField), and their angles are in radians ("yfov_deg" is yfov).
class SettingNames {
 public:
  /// A name in rigs and in the file.
  using Pair = std::pair<std::string_view, std::string_view>;

  /// `pairs` must outlive this; what is not among them is spelled as in rigs.
  constexpr SettingNames(std::span<const Pair> pairs, bool angles_in_radians)
      : pairs_(pairs), angles_in_radians_(angles_in_radians) {}

  [[nodiscard]] std::string_view spelled(std::string_view name) const {
    for (const Pair& pair : pairs_) {
      if (pair.first == name) return pair.second;
    }
    return name;
  }
  [[nodiscard]] bool angles_are_in_radians() const { return angles_in_radians_; }
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }

 private:
  std::span<const Pair> pairs_;
  bool angles_in_radians_;
};

inline constexpr SettingNames kRigNames{{}, false};
extern const SettingNames kGltfNames;

}  // namespace laterna
