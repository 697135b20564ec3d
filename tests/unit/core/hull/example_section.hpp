// Sections that several tests share.
#pragma once

#include <string>

#include "core/hull/section_shape.hpp"

namespace seaway::hull {

/// 0.3 x 0.1 m barge.
inline SectionSpec barge() {
  SectionSpec spec;
  spec.shape = SectionSpec::Shape::box;
  spec.beam = 0.3;
  spec.height = 0.1;
  return spec;
}

/// Midship section of DTMB 5415 at 1:51 with two wing compartments, openings below and vents above.
inline SectionSpec damaged_midship() {
  SectionSpec spec;
  spec.shape = SectionSpec::Shape::offsets;
  spec.offsets_file = SEAWAY_EXAMPLES "/dtmb5415_offsets.csv";
  spec.station = 71.0;
  spec.scale = 51.0;
  spec.extend_to = 0.30;
  const double bulkhead = 0.1145, outside = 0.25;
  CompartmentSpec port;
  port.name = "port wing";
  port.box = {{bulkhead, 0.020}, {outside, 0.280}};
  port.wall_thickness = 0.020;
  port.openings = {{"damage", {{0.140, 0.070}, {outside, 0.100}}},
                   {"vent", {{0.130, 0.270}, {0.160, 0.310}}}};
  CompartmentSpec starboard = port;
  starboard.name = "starboard wing";
  const auto mirror = [](Box<2>& box) {
    const double low = -box.upper.x();
    box.upper.x() = -box.lower.x();
    box.lower.x() = low;
  };
  mirror(starboard.box);
  for (OpeningSpec& opening : starboard.openings) mirror(opening.box);
  spec.compartments = {port, starboard};
  return spec;
}

}  // namespace seaway::hull
