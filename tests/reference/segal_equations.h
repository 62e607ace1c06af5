// Equations 2 to 5 of Segal et al. 1992, section 2, as printed, in double precision.
#pragma once

namespace laterna::reference {

/// One end of a span: its w in clip coordinates, and what varies linearly along the span in space.
struct SpanEnd {
  double w, value;
};

/// The value at the share `screen_share` of the span's projection: with a = 1 − t^s and b = t^s, A = a w2 and B = b w1,
/// Q = (A Q1 + B Q2) / (A + B).
constexpr double value_on_span(SpanEnd first, SpanEnd second, double screen_share) {
  const double a = 1 - screen_share;
  const double b = screen_share;
  const double A = a * second.w;
  const double B = b * first.w;
  return (A * first.value + B * second.value) / (A + B);
}

}  // namespace laterna::reference
