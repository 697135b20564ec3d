#include "core/hull/surface_hull.hpp"

#include "core/base/error.hpp"
#include "core/hull/surface_patch.hpp"

namespace seaway::hull {

SurfaceHull::SurfaceHull(Surface surface, double spacing, double margin) {
  const auto problems = find_surface_problems(surface);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument, "{}; {}", problems[0].message, problems[0].hint);
  bounds_ = bounds_of(surface);
  solids_.push_back(std::make_shared<SurfaceTree>(std::move(surface)));
  table_ = std::make_shared<DistanceGrid>(*solids_.front(), spacing, margin);
}

std::unique_ptr<HullPatch<3>> SurfaceHull::patch(const OrientedBox<3>& block) const {
  return std::make_unique<SurfacePatch>(solids_, block, table_, false);
}

}  // namespace seaway::hull
