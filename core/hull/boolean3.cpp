// The only file that sees CGAL: it compiles slowly.
#include "core/hull/boolean3.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh to_cgal(const Surface& s) {
  Mesh mesh;
  mesh.reserve(static_cast<Mesh::size_type>(s.vertices.size()),
               static_cast<Mesh::size_type>(2 * s.triangles.size()),
               static_cast<Mesh::size_type>(s.triangles.size()));
  for (const Vec3& x : s.vertices) mesh.add_vertex(Kernel::Point_3(x.x(), x.y(), x.z()));
  const auto v = [](int i) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(i)); };
  for (const auto& t : s.triangles)
    SEAWAY_CHECK(mesh.add_face(v(t[0]), v(t[1]), v(t[2])) != Mesh::null_face(),
                 "an edge or corner of the surface joins more than two sheets");
  return mesh;
}

Surface from_cgal(Mesh mesh) {
  mesh.collect_garbage();
  Surface s;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    s.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> t{};
    int n = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      t[static_cast<std::size_t>(n++)] = static_cast<int>(v.idx());
    s.triangles.push_back(t);
  }
  return s;
}

enum class Operation { subtract, intersect, unite };

Surface combine(const Surface& a, const Surface& b, Operation operation) {
  if (a.triangles.empty()) return operation == Operation::unite ? b : Surface{};
  if (b.triangles.empty()) return operation == Operation::intersect ? Surface{} : a;
  try {
    Mesh p = to_cgal(a), q = to_cgal(b), out;
    const auto checked = CGAL::parameters::throw_on_self_intersection(true);
    bool ok = false;
    switch (operation) {
      case Operation::subtract:
        ok = pmp::corefine_and_compute_difference(p, q, out, checked);
        break;
      case Operation::intersect:
        ok = pmp::corefine_and_compute_intersection(p, q, out, checked);
        break;
      case Operation::unite:
        ok = pmp::corefine_and_compute_union(p, q, out, checked);
        break;
    }
    SEAWAY_CHECK(ok, "two bodies touch along a line or at a point; move or enlarge one a little");
    return from_cgal(std::move(out));
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    fail(ErrorCode::invalid_argument,
         "a surface crosses itself where it meets the other one; repair it or make it coarser");
  } catch (const CGAL::Failure_exception& error) {
    fail(ErrorCode::invalid_argument, "the surfaces cannot be combined: {}", error.what());
  }
}

}  // namespace

std::optional<std::pair<int, int>> first_crossing(const Surface& s) {
  try {
    const Mesh mesh = to_cgal(s);
    using Face = Mesh::Face_index;
    std::vector<std::pair<Face, Face>> pairs;
    pmp::self_intersections(mesh, std::back_inserter(pairs));
    if (pairs.empty()) return std::nullopt;
    const auto number = [](Face f) { return static_cast<int>(f.idx()); };
    std::pair<int, int> first{1 << 30, 0};
    for (const auto& [f, g] : pairs)
      first = std::min(first, {std::min(number(f), number(g)), std::max(number(f), number(g))});
    return first;
  } catch (const CGAL::Failure_exception& error) {
    fail(ErrorCode::invalid_argument, "the surface cannot be searched for crossings: {}",
         error.what());
  }
}

Surface subtract(const Surface& a, const Surface& b) { return combine(a, b, Operation::subtract); }
Surface intersect(const Surface& a, const Surface& b) {
  return combine(a, b, Operation::intersect);
}
Surface unite(const Surface& a, const Surface& b) { return combine(a, b, Operation::unite); }

}  // namespace seaway::hull
