// Numbers that pictures of a mean are told apart by: where in a pixel, from where on a light, through which point of a lens.
#pragma once

namespace laterna {

/// Picture number `index` of `count` whose mean is the picture (RenderSettings::accumulate).
struct SampleIndex {
  int index = 0, count = 1;
};

/// What pictures differ in. Each has numbers of its own, so that every two of them fill their square evenly; lights may
/// share theirs with each other and with lenses, because what they give is added. `instant`: within the shutter's time.
enum class SampleDimension { pixel_x, pixel_y, source, instant };

/// A number in (0, 1) for each picture, ½ for the first. The first few are spread over the whole too, so that one may stop
/// early: fractions of multiples of an irrational number (Kronecker's sequence).
double sample_number(SampleIndex sample, SampleDimension dimension);

/// All of 0 … count − 1, each once, for numbers that are to lie in `count` equal fields exactly; spread likewise.
int sample_field(SampleIndex sample);

/// A point of the unit square.
struct LatticePoint {
  double u, v;
};
/// Of `count` points that fill the square evenly, where all of them are used: the Fibonacci lattice, (i + ½) / count and the
/// fraction of i golden ratios.
LatticePoint lattice_point(SampleIndex sample);

}  // namespace laterna
