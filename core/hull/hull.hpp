// What the flow solver may ask of a hull: how far is a point from its surface, and how much of a small
// oriented box is solid. All in hull axes (y port, z up from the baseline; 3-D also x forward).
//
// Thread-safe after construction (const everywhere).
#pragma once

#include <memory>

#include "core/base/vec.hpp"

namespace seaway::hull {

template <int Dim>
struct Box {
  Vec<Dim> lower, upper;
};

/// A control volume of the grid as the hull sees it: the grid's axes are rotated against the hull's.
template <int Dim>
struct OrientedBox {
  Vec<Dim> centre;
  Vec<Dim> half;                             ///< half edges along its own axes [m]
  Eigen::Matrix<double, Dim, Dim> axes;      ///< columns: its axes (grid axes) in hull axes
};

/// Solid part of a control volume. Permeability p < 1 makes the inside of a compartment solid by 1 - p.
template <int Dim>
struct SolidPart {
  double volume = 0;                         ///< [m^Dim]
  Vec<Dim> moment = Vec<Dim>::Zero();        ///< integral of x over the solid part, hull axes
};

/// Half space n.x <= d in hull axes: the water side of an interface plane.
template <int Dim>
struct HalfSpace {
  Vec<Dim> normal;
  double d = 0;
};

/// The piece of the hull inside a box: made once per mesh block so that its queries are cheap.
/// Control volumes lie inside that box and have its axes.
///
/// Connected spaces, for walls thinner than the cells: 0 is the sea, 1 + i compartment i. Each point
/// belongs to one of them or to a wall; openings (the holes in walls) belong to the sea.
template <int Dim>
class HullPatch {
 public:
  virtual ~HullPatch() = default;
  /// Exact for the polygons (2-D) or the closed triangle surface (3-D).
  virtual SolidPart<Dim> solid_part(const OrientedBox<Dim>& cv) const = 0;
  /// Solid volume inside both the control volume and the half space.
  virtual double solid_volume_below(const OrientedBox<Dim>& cv, const HalfSpace<Dim>& water) const = 0;
  /// Solid fraction (0..1) of the face of `cv` on side `high` (false: lower) of its own axis `axis`.
  virtual double solid_face_fraction(const OrientedBox<Dim>& cv, int axis, bool high) const = 0;

  /// As the three above for all that is not fluid of connected space `space`: walls and the other
  /// spaces, and of the space itself what its permeability leaves solid. A hull without
  /// compartments has space 0 alone, for which they are the same.
  virtual SolidPart<Dim> outside_space(const OrientedBox<Dim>& cv, int /*space*/) const { return solid_part(cv); }
  virtual double outside_space_below(const OrientedBox<Dim>& cv, const HalfSpace<Dim>& water, int /*space*/) const {
    return solid_volume_below(cv, water);
  }
  virtual double outside_space_face_fraction(const OrientedBox<Dim>& cv, int axis, bool high, int /*space*/) const {
    return solid_face_fraction(cv, axis, high);
  }
  /// Part of the control volume in the openings' boxes, each extended along its thinnest direction
  /// on both sides by a length that was given when the hull was made. Boxes that overlap count twice,
  /// up to the whole control volume.
  virtual SolidPart<Dim> opening_part(const OrientedBox<Dim>& /*cv*/) const { return {}; }
};

template <int Dim>
class Hull {
 public:
  virtual ~Hull() = default;
  /// Signed distance to the nearest wall [m], > 0 in water or air (also inside compartments), < 0 in solid.
  /// Interpolated from a table near the hull (error below 2 % of the table's spacing away from
  /// corners); beyond its margin any value larger than the margin.
  virtual double signed_distance(const Vec<Dim>& x) const = 0;
  /// Gradient of the distance (points into the fluid), not normalised.
  virtual Vec<Dim> distance_gradient(const Vec<Dim>& x) const = 0;
  /// `block` in hull axes; its half edges hold the margin in which control volumes may lie.
  virtual std::unique_ptr<HullPatch<Dim>> patch(const OrientedBox<Dim>& block) const = 0;
  virtual Box<Dim> bounds() const = 0;
  /// Compartment index at a point, or -1 (sea, or solid).
  virtual int compartment_at(const Vec<Dim>& x) const = 0;
  virtual int n_compartments() const = 0;
  /// Around all compartments; lower > upper if there are none.
  virtual Box<Dim> compartment_bounds() const {
    return {Vec<Dim>::Constant(1e300), Vec<Dim>::Constant(-1e300)};
  }
  /// Whether any compartment has a permeability below 1.
  virtual bool has_porous_space() const { return false; }
  /// Connected space (0 sea, 1 + i compartment i) whose fluid is nearest to x, also defined in walls;
  /// inside an opening's box -1.
  virtual int space_near(const Vec<Dim>& /*x*/) const { return 0; }
};

}  // namespace seaway::hull
