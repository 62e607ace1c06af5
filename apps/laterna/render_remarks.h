// What there is to say of pictures: remarks on standard error, and what they cost, in JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "render_request.h"

namespace laterna::app {

/// For --json. `load_ms`: milliseconds until the first picture was begun.
nlohmann::json statistics_json(const RenderStatistics& statistics, double load_ms);

/// Keeps users from wondering at white or black pictures.
void advise_exposure(const LayeredImage& image, float exposure, bool is_automatic);

/// A lamp with a size and a lens that is open throw soft shadows, but most techniques see their middle alone.
void advise_softness(const Scene& scene, ShadowTechnique for_all);

/// Only one model's numbers are candela per square metre.
void advise_luminance(const RenderRequest& request);

/// A projector that is aimed past everything is seldom meant.
void tell_idle_projectors(const Renderer& renderer);

/// `noise`: a fraction of the mean luminance.
void tell_noise(int pictures, double noise);

}  // namespace laterna::app
