// Where the hull is in the mesh: apertures of faces, fluid fractions of cells, and what follows from them for
// the rigid body in the pressure solve. Apertures are the fluid part of the staggered control volumes
// [batty2007], not of the faces: that makes the pressure force smooth in the hull's position and Archimedes'
// law exact (docs/numerics.md, section "Hull").
//
// Walls thinner than two cells cannot be resolved by apertures. With Walls::thin every cell belongs to a connected
// space (the sea, a compartment); apertures and fluid fractions count that space alone, and a face between cells
// of different spaces is closed but for the openings in the wall. What a closed face cuts off from a space rides
// with the hull: carried_weight() is its weight.
#pragma once

#include <memory>

#include "core/flow/flow_state.hpp"
#include "core/flow/hull_window.hpp"
#include "core/hull/hull.hpp"
#include "core/linear/poisson_operator.hpp"
#include "core/motion/rigid_body.hpp"

namespace seaway::flow {

/// Apertures below this are closed: the velocity in them is hardly constrained.
inline constexpr double smallest_aperture = 0.005;

/// How walls between spaces hold water: as solid that the cells resolve, or by the space of each cell.
enum class Walls { resolved, thin };

/// The hull at one pose, sampled on the window.
template <int Dim>
struct HullGeometry {
  motion::Pose<Dim> pose;
  std::vector<double> phi;                          ///< cells: signed distance, > 0 in fluid [m]
  std::array<std::vector<double>, Dim> aperture;    ///< faces: 0..1
  /// Faces with 0 < aperture < 1, else not set: centroid of the open part less the cog [m].
  std::array<std::vector<Vec<Dim>>, Dim> arm;
  std::vector<signed char> space;                   ///< cells: 0 sea, 1 + compartment, passage; empty: Walls::resolved
};

template <int Dim>
class HullMask {
 public:
  /// `clearance`: width of the window around the hull's bounds, in finest cells. `fixed`: an obstacle that never
  /// moves and may reach through the tank's sides.
  HullMask(const Forest<Dim>& forest, std::shared_ptr<const hull::Hull<Dim>> hull,
           const motion::RigidBody<Dim>& body, int clearance = 6, Walls walls = Walls::resolved,
           bool fixed = false);

  /// Geometry at the pose of the new time and at the pose half a step later. Throws as HullWindow::cover.
  void update(const motion::Pose<Dim>& now, const motion::Pose<Dim>& half_step);

  const HullWindow<Dim>& window() const { return window_; }
  const HullGeometry<Dim>& now() const { return now_; }
  const HullGeometry<Dim>& half() const { return half_; }
  /// Fluid part of each cell at the new time; permeability counts as solid.
  const std::vector<double>& fluid_fraction() const { return theta_; }
  /// Solid part of each face at the half-step pose.
  const std::vector<double>& solid_face(int axis) const { return solid_face_[static_cast<std::size_t>(axis)]; }
  /// Wall in a cell at the half-step pose, area times normal into the fluid: what closes the open parts of the cell's
  /// faces [m^(Dim-1)].
  Vec<Dim> wall_area(const IVec<Dim>& cell) const;
  /// Whether the blocks of the window changed in the last update.
  bool moved() const { return moved_; }

  /// Solid below the interface plane of a cell at the new time [m^Dim]: what the cell's water volume has to
  /// be reduced by to get the water that is really there.
  double submerged_solid(const IVec<Dim>& cell, const std::array<double, Dim>& normal, double d) const;

  /// Rows J_c of the rigid body for a geometry (sum over the cell's faces, about the cog).
  linear::RigidRows<Dim> rigid_rows(const HullGeometry<Dim>& geometry) const;

  /// Weight of the water and air that Walls::thin takes from the spaces, and its moment about the cog, at the new
  /// time [N, N m; 2-D per metre]: with it Archimedes' law holds as for resolved walls. `vof`: window array.
  motion::DofVector<Dim> carried_weight(const std::vector<double>& vof, const FluidProperties& fluids) const;

  /// Velocity of fluid and hull through full faces, w = a u + v_s(centre) - a v_s(open centroid), in the
  /// window; `u` and `w` are window arrays of the axis.
  void mixture_velocity(int axis, const motion::Twist<Dim>& twist, const std::vector<double>& u,
                        std::vector<double>& w) const;

  /// Connected space of a point in the earth frame: 0 sea, 1 + compartment.
  int space_at(const Vec<Dim>& x) const;
  Walls walls() const { return walls_; }
  /// Whether a face (entry of a geometry's arrays) is a wall between two spaces.
  bool is_wall(const HullGeometry<Dim>& g, std::size_t at, int axis, bool first) const {
    return !g.space.empty() && !first && apart(g.space[at], g.space[at - static_cast<std::size_t>(window_.stride(axis))]);
  }
  const motion::RigidBody<Dim>& body() const { return body_; }

 private:
  void sample_distance(HullGeometry<Dim>& g) const;
  void find_apertures(HullGeometry<Dim>& g, bool with_solid_faces);
  void find_fluid_fractions();
  void find_spaces(HullGeometry<Dim>& g) const;
  hull::SolidPart<Dim> closed_part(const HullGeometry<Dim>& g, const hull::HullPatch<Dim>& patch,
                                   const hull::OrientedBox<Dim>& box, const IVec<Dim>& face, int axis) const;
  void find_carried();
  hull::OrientedBox<Dim> box_at(const HullGeometry<Dim>& g, const Vec<Dim>& centre) const;
  void make_patches(const HullGeometry<Dim>& g, std::vector<std::unique_ptr<hull::HullPatch<Dim>>>& out) const;
  bool porous(const HullGeometry<Dim>& g, const Vec<Dim>& x) const;

  std::shared_ptr<const hull::Hull<Dim>> hull_;
  motion::RigidBody<Dim> body_;
  HullWindow<Dim> window_;
  int clearance_;
  double clip_distance_ = 0;  ///< |phi| beyond which a control volume is wholly fluid or solid
  HullGeometry<Dim> now_, half_;
  std::vector<double> theta_;
  std::array<std::vector<double>, Dim> solid_face_;
  std::vector<std::unique_ptr<hull::HullPatch<Dim>>> patches_;  ///< by tile, at the new pose
  /// Fluid of a space that a closed vertical face cuts off from it.
  struct Carried {
    double volume = 0;                    ///< [m^Dim]
    Vec<Dim> arm = Vec<Dim>::Zero();      ///< its centroid less the cog [m]
    std::array<int, 2> cells{};           ///< window entries with its volume fraction
  };
  std::vector<Carried> carried_;
  Walls walls_;
  bool moved_ = true;
  bool has_pose_ = false;
};

extern template class HullMask<2>;
extern template class HullMask<3>;

}  // namespace seaway::flow
