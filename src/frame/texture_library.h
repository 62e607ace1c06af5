// Every picture of a scene, decoded once and prepared for look-ups.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "base/task_pool.h"
#include "image/mip_chain.h"
#include "laterna/scene.h"

namespace laterna::frame {

class TextureLibrary {
 public:
  /// Decodes the pictures that materials and lights use, in parallel, each once however often it is used.
  /// Errors of all pictures are collected.
  static Result<TextureLibrary> load(const Scene& scene, const TaskPool& pool,
                                     InstructionSet set = best_instruction_set());

  /// Null where `picture` is −1 or was not asked for with this use.
  [[nodiscard]] const image::MipChain* find(int picture, image::MipUse use) const;

 private:
  std::map<std::pair<int, image::MipUse>, std::unique_ptr<image::MipChain>> chains_;
};

/// How a material's base colour is kept: with alpha only where alpha is looked at.
image::MipUse base_color_use(const Material& material);
/// A slide is colour; an intensity map is numbers.
image::MipUse slide_use(const Light& light);

}  // namespace laterna::frame
