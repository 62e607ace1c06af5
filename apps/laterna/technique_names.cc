#include "technique_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene_options.h"

namespace laterna::app {

std::vector<std::string> technique_names() {
  std::vector<std::string> names;
  for (const TechniqueDescription& t : list_techniques()) names.emplace_back(t.name);
  return names;
}

std::string name_of(ShadowTechnique technique) {
  for (const TechniqueDescription& t : list_techniques()) {
    if (t.technique == technique) return std::string(t.name);
  }
  return {};
}

Result<std::vector<ShadowTechnique>> parse_techniques(const std::string& list) {
  std::vector<ShadowTechnique> techniques;
  std::string known;
  for (const TechniqueDescription& t : list_techniques()) {
    known += fmt::format(", {}", t.name);
    if (list == "all") techniques.push_back(t.technique);
  }
  if (list == "all") return techniques;
  for (const std::string& name : split_list(list)) {
    const auto all = list_techniques();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& t) { return t.name == name; });
    if (found == all.end()) {
      return tl::unexpected(bad_option(
          fmt::format("--techniques: there is no technique \"{}\"; there are all{}", name, known)));
    }
    if (std::find(techniques.begin(), techniques.end(), found->technique) == techniques.end())
      techniques.push_back(found->technique);
  }
  if (techniques.empty()) {
    return tl::unexpected(bad_option(fmt::format("--techniques: expected names; there are all{}", known)));
  }
  return techniques;
}

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  while (start <= list.size()) {
    const std::size_t end = std::min(list.find(',', start), list.size());
    if (end > start) parts.push_back(list.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

}  // namespace laterna::app
