#include "scene/relief_settings.h"

namespace laterna {

void read_relief_settings(JsonObject& object, Relief& relief) {
  constexpr NumberRange kDepth{0, kMaxReliefDepth, false, false};
  relief.depth = object.number("depth", kDepth).value_or(relief.depth);
  relief.kind =
      object.choice<ReliefKind>("kind", {{"height", ReliefKind::height}, {"depth", ReliefKind::depth}})
          .value_or(relief.kind);
  relief.self_shadow = object.boolean("self_shadow").value_or(relief.self_shadow);
  relief.cut_edges = object.boolean("cut_edges").value_or(relief.cut_edges);
}

}  // namespace laterna
