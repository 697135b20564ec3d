// Closed surfaces of simple shapes and of ships given by offsets. Baseline at z = 0, x = 0
// amidships, y = 0 the centre plane; decks are flat and closed. Sizes [m].
//
// Round shapes are faceted with vertices a little outside the true surface, so that the volume of
// the polyhedron equals that of the true shape to rounding (cylinder, sphere); the Wigley hull is
// inscribed. Each throws Error(invalid_argument) for sizes that are not positive. Pure functions.
#pragma once

#include "core/hull/offsets_table.hpp"
#include "core/hull/surface.hpp"

namespace seaway::hull {

/// |x| <= length / 2, |y| <= beam / 2, 0 <= z <= height; 12 triangles.
Surface box_surface(double length, double beam, double height);

/// Box with rounded bilges: the section of SectionSpec::Shape::rounded_box (16 chords a corner),
/// flat ends. Before: 0 < radius <= min(beam / 2, height).
Surface rounded_box_surface(double length, double beam, double height, double radius);

/// Circular cylinder with its axis along x at z = radius. The n_around (>= 8) facets are placed so
/// that the volume is pi radius^2 length.
Surface cylinder_surface(double length, double radius, int n_around = 96);

/// Sphere around (0, 0, radius). The facets (n >= 8 from pole to pole, 2 n around) are placed so
/// that the volume is 4/3 pi radius^3.
Surface sphere_surface(double radius, int n = 48);

/// Wigley hull y = +-beam/2 (1 - (2x/length)^2) (1 - (z/draft - 1)^2), z <= draft, with vertical
/// sides from there to `height` >= draft; n_x columns, n_z rows below z = draft. The volume below
/// z = draft is 4/9 length beam draft (1 - O(1/n^2)): 0.4 % less at 60 x 20.
Surface wigley_surface(double length, double beam, double draft, double height, int n_x = 96,
                       int n_z = 32);

struct OffsetsHullSpec {
  double scale = 1;   ///< lengths of the table are divided by it
  double origin = 0;  ///< x of the hull axes' origin in the table's unit: amidships
  double extend_to =
      0;  ///< sides go on vertically to this z [m, after scaling]; 0: deck at its edge
  double max_step = 0;  ///< longest distance of columns [table's unit]; 0: 1 % of the length
  int n_girth = 48;     ///< facets from the keel to the deck edge, >= 8
};

/// Ship out of a table of half-breadths. Each section becomes one curve from the keel to the deck
/// edge with its points at equal shares of the girth; between stations the points run along
/// monotone cubics, so that nothing overshoots. The ends are closed by flat
/// transoms, the deck is flat across. A gap in the sections of some stations (a notch between a
/// bulbous dome and the stem) is kept: above and below it the hull goes on on its own; a lower
/// part that does not reach the next station ends in a nose, an ellipse-like extrapolation of its
/// half-breadths. Symmetric. The deck has to be given by deck_z and deck_y or by the topmost
/// waterline of each station.
/// Throws Error(invalid_argument): fewer than 2 stations, a station with fewer than 2 points, two
/// gaps, gaps that are not at consecutive stations, extend_to below the deck, missing stations.
Surface offsets_surface(const OffsetsTable& table, const OffsetsHullSpec& spec);

}  // namespace seaway::hull
