// What the words after options of `laterna render` stand for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::app {

inline const std::map<std::string, ShadingModel> kShading = {
    {"papers", ShadingModel::papers}, {"phong", ShadingModel::phong}, {"pbr", ShadingModel::pbr}};
inline const std::map<std::string, Passes> kPasses = {{"single", Passes::single}, {"multi", Passes::multi}};
inline const std::map<std::string, Interpolation> kInterpolation = {
    {"perspective", Interpolation::perspective}, {"affine", Interpolation::affine}};
inline const std::map<std::string, WriteOptions::Depth> kDepth = {{"auto", WriteOptions::Depth::automatic},
                                                                  {"8", WriteOptions::Depth::bits8},
                                                                  {"16", WriteOptions::Depth::bits16},
                                                                  {"half", WriteOptions::Depth::half},
                                                                  {"float", WriteOptions::Depth::single}};

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& map) {
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

}  // namespace laterna::app
