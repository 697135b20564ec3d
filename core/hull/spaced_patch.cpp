#include "core/hull/spaced_patch.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::hull {

namespace {

template <int Dim>
double volume_of(const OrientedBox<Dim>& cv) {
  return (1 << Dim) * cv.half.prod();
}

/// Mean over s in [-1, 1] of clamp(a + b s, 0, 1), b >= 0; exact, no cancellation for small b.
double mean_of_clamp(double a, double b) {
  const double low = a - b, high = a + b;
  if (high <= 0) return 0;
  if (low >= 1) return 1;
  if (low >= 0 && high <= 1) return a;
  if (low >= 0) return (low + high) / 2 - (high - 1) * (high - 1) / (2 * (high - low));
  return high <= 1 ? high * high / (2 * (high - low)) : (high - 0.5) / (high - low);
}

/// The same over s, t in [-1, 1] of clamp(a + b s + c t, 0, 1): between the values of t at which a
/// corner passes 0 or 1 the mean over s is quadratic, and two Gauss points are exact.
double mean_of_clamp(double a, double b, double c) {
  double cuts[6] = {-1};
  int n = 1;
  if (c > 0)
    for (const double level : {0.0, 1.0})
      for (const double side : {-b, b}) {
        const double t = (level - a - side) / c;
        if (!(t > -1 && t < 1)) continue;
        int at = n++;
        for (; at > 1 && cuts[at - 1] > t; --at) cuts[at] = cuts[at - 1];
        cuts[at] = t;
      }
  cuts[n++] = 1;
  double sum = 0;
  for (int i = 0; i + 1 < n; ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]), half = 0.5 * (cuts[i + 1] - cuts[i]);
    const double off = half * 0.57735026918962576;
    sum += half *
           (mean_of_clamp(a + c * (middle - off), b) + mean_of_clamp(a + c * (middle + off), b));
  }
  return 0.5 * sum;
}

}  // namespace

template <int Dim>
double box_volume_below(const OrientedBox<Dim>& cv, const HalfSpace<Dim>& water) {
  Vec<Dim> n = (cv.axes.transpose() * water.normal).cwiseAbs().cwiseProduct(cv.half);
  const double d = water.d - water.normal.dot(cv.centre);
  int u = 0;
  const double most = n.maxCoeff(&u);
  const double volume = volume_of(cv);
  if (most == 0) return d >= 0 ? volume : 0.0;
  // Height of the plane over the box's foot along its steepest axis, as a share of the edge; the
  // sides of the plane do not matter for the mean, only the sizes of its slopes.
  const double a = 0.5 * (1 + d / most);
  if constexpr (Dim == 2) {
    return volume * mean_of_clamp(a, 0.5 * n[1 - u] / most);
  } else {
    return volume * mean_of_clamp(a, 0.5 * n[(u + 1) % 3] / most, 0.5 * n[(u + 2) % 3] / most);
  }
}

template <int Dim>
SolidPart<Dim> SpacedPatch<Dim>::outside_space(const OrientedBox<Dim>& cv, int space) const {
  SolidPart<Dim> out;
  if (space == 0) {
    out = solid_->solid_part(cv);
    for (const Space& s : spaces_) {
      if (s.patch == nullptr) continue;
      const SolidPart<Dim> part = s.patch->solid_part(cv);
      out.volume += s.permeability * part.volume;
      out.moment += s.permeability * part.moment;
    }
    return out;
  }
  out.volume = volume_of(cv);
  out.moment = out.volume * cv.centre;
  const Space& s = spaces_.at(static_cast<std::size_t>(space - 1));
  if (s.patch == nullptr) return out;
  const SolidPart<Dim> part = s.patch->solid_part(cv);
  out.volume -= s.permeability * part.volume;
  out.moment -= s.permeability * part.moment;
  return out;
}

template <int Dim>
double SpacedPatch<Dim>::outside_space_below(const OrientedBox<Dim>& cv,
                                             const HalfSpace<Dim>& water, int space) const {
  if (space == 0) {
    double out = solid_->solid_volume_below(cv, water);
    for (const Space& s : spaces_)
      if (s.patch != nullptr) out += s.permeability * s.patch->solid_volume_below(cv, water);
    return out;
  }
  const double all = box_volume_below(cv, water);
  const Space& s = spaces_.at(static_cast<std::size_t>(space - 1));
  if (s.patch == nullptr) return all;
  return std::max(0.0, all - s.permeability * s.patch->solid_volume_below(cv, water));
}

template <int Dim>
double SpacedPatch<Dim>::outside_space_face_fraction(const OrientedBox<Dim>& cv, int axis,
                                                     bool high, int space) const {
  if (space == 0) {
    double out = solid_->solid_face_fraction(cv, axis, high);
    for (const Space& s : spaces_)
      if (s.patch != nullptr) out += s.permeability * s.patch->solid_face_fraction(cv, axis, high);
    return std::min(out, 1.0);
  }
  const Space& s = spaces_.at(static_cast<std::size_t>(space - 1));
  return s.patch == nullptr ? 1.0
                            : 1.0 - s.permeability * s.patch->solid_face_fraction(cv, axis, high);
}

template class SpacedPatch<2>;
template class SpacedPatch<3>;
template double box_volume_below<2>(const OrientedBox<2>&, const HalfSpace<2>&);
template double box_volume_below<3>(const OrientedBox<3>&, const HalfSpace<3>&);

}  // namespace seaway::hull
