// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a case.
#include <fmt/format.h>

#include "server/convert/case_parts.hpp"

namespace seaway::convert {
namespace {

void read_mesh(const v1::MeshRule& m, const std::string& path, int dim, sim::MeshRule& mesh, Checker& check) {
  if (m.has_hull_cell_m()) mesh.hull_cell = check.number(path + ".hull_cell_m", m.hull_cell_m(), positive);
  if (m.has_hull_margin_m()) mesh.hull_margin = check.number(path + ".hull_margin_m", m.hull_margin_m(), not_negative);
  if (m.has_hull_sweep_deg())
    mesh.hull_sweep = check.number(path + ".hull_sweep_deg", m.hull_sweep_deg(), {0, 180}) * degree;
  if (m.has_hull_heave_m()) mesh.hull_heave = check.number(path + ".hull_heave_m", m.hull_heave_m(), not_negative);
  check.entries(path + ".surface", m.surface_size(), 0, 16);
  for (int i = 0; i < m.surface_size(); ++i) {
    const std::string band_path = fmt::format("{}.surface[{}].", path, i);
    sim::SurfaceBand band;
    band.cell = check.number(band_path + "cell_m", m.surface(i).cell_m(), positive);
    band.half_height = check.number(band_path + "half_height_m", m.surface(i).half_height_m(), positive);
    if (m.surface(i).has_within_m()) band.within = check.number(band_path + "within_m", m.surface(i).within_m(), positive);
    mesh.surface.push_back(band);
  }
  check.entries(path + ".boxes", m.boxes_size(), 0, 64);
  for (int i = 0; i < m.boxes_size(); ++i) {
    const std::string box_path = fmt::format("{}.boxes[{}]", path, i);
    sim::RefinementBox box;
    box.cell = check.number(box_path + ".cell_m", m.boxes(i).cell_m(), positive);
    read_box(m.boxes(i).x_m(), m.boxes(i).y_m(), m.boxes(i).z_m(), box_path, dim, box.lower, box.upper, check);
    mesh.boxes.push_back(box);
  }
}

void read_end(const v1::EndRule& m, const std::string& path, sim::EndRule& end, Checker& check) {
  switch (m.rule_case()) {
    case v1::EndRule::kTime:
      end.kind = sim::EndRule::Kind::time;
      end.duration = check.number(path + ".time.duration_s", m.time().duration_s(), positive);
      break;
    case v1::EndRule::kConverged: {
      const v1::EndWhenConverged& r = m.converged();
      end.kind = sim::EndRule::Kind::converged;
      if (r.has_tolerance())
        end.tolerance = check.number(path + ".converged.tolerance", r.tolerance(), {0, 1, true});
      if (r.has_min_periods())
        end.min_periods = check.number(path + ".converged.min_periods", r.min_periods(), {0, 1000});
      if (r.has_max_periods()) end.max_periods = r.max_periods();
      check.number(path + ".converged.max_periods", end.max_periods, {end.min_periods, 10000});
      break;
    }
    case v1::EndRule::RULE_NOT_SET:
      check.problem(path, "is missing", "write time: with duration_s, or converged: {}");
  }
}

void read_mapping(const v1::Mapping& m, const std::string& path, sim::Mapping& mapping, Checker& check) {
  if (m.method() != v1::Mapping::METHOD_UNSPECIFIED)
    mapping.method = static_cast<sim::Mapping::Method>(m.method() - 1);
  if (m.kernel() != v1::Mapping::KERNEL_UNSPECIFIED)
    mapping.kernel = static_cast<sim::Mapping::Kernel>(m.kernel() - 1);
  if (m.ordering() != v1::Mapping::ORDERING_UNSPECIFIED)
    mapping.ordering = static_cast<sim::Mapping::Ordering>(m.ordering() - 1);
  if (mapping.method != sim::Mapping::Method::prbf)
    for (const auto& [given, name] : {std::pair{m.has_k(), ".k"}, {m.has_subsets(), ".subsets"},
                                      {m.has_evaluate_all(), ".evaluate_all"}})
      if (given) check.problem(path + name, "has an effect only with method: prbf", "remove it");
  if (m.has_k()) mapping.k = check.count(path + ".k", m.k(), 1, 100000);
  if (m.has_subsets()) mapping.subsets = check.count(path + ".subsets", m.subsets(), 0, mapping.k);
  if (m.has_shape()) mapping.shape = check.number(path + ".shape", m.shape(), {0, 1000, true});
  if (m.has_tail_degree()) mapping.tail_degree = check.count(path + ".tail_degree", m.tail_degree(), -1, 3);
  if (m.has_seed()) mapping.seed = m.seed();
  if (m.has_evaluate_all()) mapping.evaluate_all = m.evaluate_all();
}

}  // namespace

void read_cascade(const v1::Cascade& m, int dim, std::vector<sim::Stage>& stages, Checker& check) {
  if (m.stages_size() == 0) {
    check.problem("cascade.stages", "is missing", "give at least one stage with mesh and end");
    return;
  }
  check.entries("cascade.stages", m.stages_size(), 1, 16);
  for (int i = 0; i < m.stages_size(); ++i) {
    const v1::Stage& from = m.stages(i);
    const std::string path = fmt::format("cascade.stages[{}]", i);
    sim::Stage to;
    to.name = from.name().empty() ? fmt::format("{}", i + 1) : from.name();
    check.line(path + ".name", from.name(), 40);
    read_time_step(from.time(), path + ".time", to, check);
    read_mesh(from.mesh(), path + ".mesh", dim, to.mesh, check);
    read_end(from.end(), path + ".end", to.end, check);
    if (i == 0 && from.has_mapping())
      check.problem(path + ".mapping", "has no effect in the first stage", "remove it");
    read_mapping(from.mapping(), path + ".mapping", to.mapping, check);
    stages.push_back(std::move(to));
  }
}

}  // namespace seaway::convert
