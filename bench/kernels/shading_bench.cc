// Visible samples to radiance: surface points with their textures, arriving light, reflection.
#include "drawing.h"
#include "kernel_run.h"
#include "shade/illumination.h"

namespace laterna {
namespace {

// In the foreground of the lit floor.
FloorSamples foreground(InstructionSet set, int anisotropy = 1) { return {256, 384, set, anisotropy}; }

void surface_points(benchmark::State& state, InstructionSet set) {
  FloorSamples floor = foreground(set);
  const frame::Surface untextured;
  const shade::FindSurfacePoints kernel = shade::find_surface_points_for(set);
  measure(state, "pixels", shadow::kMaxSamples,
          [&] { kernel(floor.source, untextured, *floor.samples, *floor.points); });
}

void textured_points(benchmark::State& state, InstructionSet set, int anisotropy) {
  FloorSamples floor = foreground(set, anisotropy);
  const shade::FindSurfacePoints kernel = shade::find_surface_points_for(set);
  measure(state, "pixels", shadow::kMaxSamples,
          [&] { kernel(floor.source, floor.surface(), *floor.samples, *floor.points); });
}

shade::BoundLight bind(const FloorSamples& floor, FloorLight light, ShadingModel model) {
  return {floor.drawing.frame().lights[static_cast<std::size_t>(light)], floor.samples->ray, model, 1};
}

void arriving_light(benchmark::State& state, InstructionSet set, FloorLight type) {
  const FloorSamples floor = foreground(set);
  const shade::BoundLight light = bind(floor, type, ShadingModel::pbr);
  const auto irradiance = std::make_unique<shade::Irradiance>();
  const shade::FindIrradiance kernel = shade::find_irradiance_for(set);
  measure(state, "pixels", shadow::kMaxSamples,
          [&] { kernel(light, *floor.samples, *floor.points, nullptr, *irradiance); });
  if (irradiance->lit[0] == 0) state.SkipWithError("the light misses the samples");
}

void reflected_light(benchmark::State& state, InstructionSet set, ShadingModel model) {
  const FloorSamples floor = foreground(set);
  const auto irradiance = std::make_unique<shade::Irradiance>();
  shade::find_irradiance_for(set)(bind(floor, FloorLight::point, model), *floor.samples, *floor.points,
                                  nullptr, *irradiance);
  const auto arrival = std::make_unique<shadow::Arrival>();
  arrival->alpha.fill(1);
  const auto radiance = std::make_unique<shade::Radiance>();
  shade::ReflectionSettings settings;
  settings.model = model;
  const shade::Reflect kernel = shade::reflect_for(set);
  measure(state, "pixels", shadow::kMaxSamples, [&] {
    kernel(settings, shadow::kMaxGroups, *floor.points, *irradiance, *arrival, 0, false, *radiance);
  });
}

const bool kRegistered = [] {
  register_kernel("surface points", surface_points);
  register_kernel("surface points, trilinear texture",
                  [](benchmark::State& state, InstructionSet set) { textured_points(state, set, 1); });
  register_kernel("surface points, anisotropic texture",
                  [](benchmark::State& state, InstructionSet set) { textured_points(state, set, 8); });
  for (const FloorLight type : {FloorLight::point, FloorLight::slide}) {
    register_kernel(
        type == FloorLight::point ? "arriving light, point" : "arriving light, slide",
        [type](benchmark::State& state, InstructionSet set) { arriving_light(state, set, type); });
  }
  constexpr std::pair<const char*, ShadingModel> kModels[] = {
      {"papers", ShadingModel::papers}, {"phong", ShadingModel::phong}, {"pbr", ShadingModel::pbr}};
  for (const auto& [name, model] : kModels) {
    register_kernel(
        std::string("reflected light, ") + name,
        [model = model](benchmark::State& state, InstructionSet set) { reflected_light(state, set, model); });
  }
  return true;
}();

}  // namespace
}  // namespace laterna
