// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/hull_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/surface_cut.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/build_ship.hpp"
#include "core/sim/ship_report.hpp"
#include "server/gnuplot.hpp"

namespace seaway::server {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json row_json(const sim::DraftRow& row) {
  const hull::ShipHydrostatics& w = row.water;
  return {{"draft_m", row.draft},
          {"volume_m3", w.volume},
          {"wetted_surface_m2", w.wetted_surface},
          {"lcb_m", w.buoyancy_centre.x()},
          {"kb_m", w.buoyancy_centre.z()},
          {"waterplane_area_m2", w.waterplane_area},
          {"lcf_m", w.waterplane_centre.x()},
          {"bm_m", w.bm},
          {"bm_longitudinal_m", w.bm_longitudinal},
          {"km_m", w.buoyancy_centre.z() + w.bm}};
}

json condition_json(const sim::ShipCondition& c) {
  json out{{"floats", c.rest.floats},
           {"stable", c.rest.stable},
           {"draft_m", c.rest.at.waterline},
           {"heel_deg", c.rest.at.heel / degree},
           {"trim_deg", c.rest.at.trim / degree},
           {"gm_m", c.rest.gm.transverse},
           {"gm_longitudinal_m", c.rest.gm.longitudinal},
           {"largest_gz_m", c.largest_lever},
           {"heel_of_largest_gz_deg", c.heel_of_largest / degree},
           {"range_deg", c.range / degree},
           {"gz", json::array()},
           {"flood", json::array()}};
  for (const auto& [heel, lever] : c.righting) out["gz"].push_back({{"heel_deg", heel / degree}, {"gz_m", lever}});
  for (const auto& f : c.flood)
    out["flood"].push_back({{"compartment", f.name},
                            {"volume_m3", f.volume},
                            {"x_m", f.centre.x()},
                            {"y_m", f.centre.y()},
                            {"z_m", f.centre.z()}});
  return out;
}

json to_json(const sim::ShipReport& r) {
  const Vec3 size = r.bounds.upper - r.bounds.lower;
  json out{{"length_over_all_m", size.x()},
           {"breadth_m", size.y()},
           {"height_m", size.z()},
           {"lowest_m", r.bounds.lower.z()},
           {"triangles", r.n_triangles},
           {"enclosed_volume_m3", r.enclosed_volume},
           {"drafts", json::array()}};
  for (const auto& row : r.drafts) out["drafts"].push_back(row_json(row));
  if (r.at_draft) {
    out["at_draft"] = row_json(*r.at_draft);
    out["at_draft"]["length_waterline_m"] = r.length_waterline;
    out["at_draft"]["breadth_waterline_m"] = r.breadth_waterline;
    out["at_draft"]["block_coefficient"] = r.block_coefficient;
  }
  if (r.intact) out["intact"] = condition_json(*r.intact);
  if (r.damaged) out["damaged"] = condition_json(*r.damaged);
  return out;
}

void print_condition(const char* name, const sim::ShipCondition& c) {
  if (!c.rest.floats) {
    std::printf("\n%s: sinks\n", name);
    return;
  }
  std::printf("\n%s, at rest%s\n", name, c.rest.stable ? "" : " (no stable heel found)");
  std::printf("  draft amidships    %10.5g m\n  heel               %10.4f deg\n  trim, bow down     %10.4f deg\n",
              c.rest.at.waterline, c.rest.at.heel / degree, c.rest.at.trim / degree);
  std::printf("  GM                 %10.5g m\n  GM longitudinal    %10.5g m\n", c.rest.gm.transverse,
              c.rest.gm.longitudinal);
  std::printf("  largest GZ         %10.5g m at %.1f deg, range to %.1f deg\n", c.largest_lever,
              c.heel_of_largest / degree, c.range / degree);
  for (const auto& f : c.flood)
    std::printf("  water in %-10s%10.5g m3, centre at x %.4g, y %.4g, z %.4g m\n", f.name.c_str(), f.volume,
                f.centre.x(), f.centre.y(), f.centre.z());
}

void print_text(const sim::ShipReport& r) {
  const Vec3 size = r.bounds.upper - r.bounds.lower;
  std::printf("hull\n  length over all    %10.5g m   (x %.5g to %.5g m)\n", size.x(), r.bounds.lower.x(),
              r.bounds.upper.x());
  std::printf("  breadth            %10.5g m\n  height             %10.5g m   (z %.5g to %.5g m)\n", size.y(), size.z(),
              r.bounds.lower.z(), r.bounds.upper.z());
  std::printf("  enclosed volume    %10.5g m3  (%d triangles)\n\n", r.enclosed_volume, r.n_triangles);
  std::printf("upright, intact; x from amidships, z from the baseline\n%9s %10s %10s %9s %9s %10s %9s %9s %9s\n", "draft m",
              "volume m3", "wetted m2", "LCB m", "KB m", "Awp m2", "LCF m", "BM m", "KM m");
  const auto line = [](const sim::DraftRow& row) {
    const hull::ShipHydrostatics& w = row.water;
    std::printf("%9.5g %10.6g %10.5g %9.5g %9.5g %10.5g %9.5g %9.5g %9.5g\n", row.draft, w.volume, w.wetted_surface,
                w.buoyancy_centre.x(), w.buoyancy_centre.z(), w.waterplane_area, w.waterplane_centre.x(), w.bm,
                w.buoyancy_centre.z() + w.bm);
  };
  for (const auto& row : r.drafts) line(row);
  if (r.at_draft) {
    std::printf("\nat the draft of the case: waterline %.5g x %.5g m, block coefficient %.4f\n", r.length_waterline,
                r.breadth_waterline, r.block_coefficient);
    line(*r.at_draft);
  }
  if (r.intact) print_condition("intact", *r.intact);
  if (r.damaged) print_condition("with the flooded compartments open", *r.damaged);
}

/// Sections of the forward half to the right, of the aft half to the left.
void write_body_plan(const hull::Ship& ship, const fs::path& file) {
  const hull::Box<3> box = hull::bounds_of(ship.outer);
  std::ofstream out(file);
  out << "# body plan: y m, z m; a blank line between sections; aft half mirrored to the left\n";
  constexpr int n_sections = 20;
  const double length = box.upper.x() - box.lower.x(), middle = 0.5 * (box.lower.x() + box.upper.x());
  for (int i = 0; i <= n_sections; ++i) {
    double x = box.lower.x() + length * i / n_sections;
    x = std::min(std::max(x, box.lower.x() + 1e-4 * length), box.upper.x() - 1e-4 * length);
    const double side = x < middle - 1e-9 * length ? -1 : 1;
    for (auto loop : hull::cut_surface(ship.outer, Vec3::UnitX(), x)) {
      if (loop.empty()) continue;
      loop.push_back(loop.front());
      bool drawn = false;
      for (const Vec3& p : loop) {
        if (p.y() >= -1e-9 * length) {
          out << side * p.y() << ' ' << p.z() << '\n';
          drawn = true;
        } else if (drawn) {
          out << '\n';
          drawn = false;
        }
      }
      if (drawn) out << '\n';
    }
  }
}

void draw(const hull::Ship& ship, const sim::ShipReport& r, const fs::path& folder) {
  fs::create_directories(folder);
  write_body_plan(ship, folder / "body_plan.txt");
  std::ofstream script(folder / "hull.gp");
  script << "cd '" << fs::absolute(folder).string() << "'\n"
         << "set terminal pngcairo size 900,700 font ',11'\nset grid\nset key off\n"
         << "set output 'body_plan.png'\nset size ratio -1\nset xlabel 'y [m]   aft | forward'\nset ylabel 'z [m]'\n";
  if (r.at_draft) script << "set arrow 1 from graph 0, first " << r.at_draft->draft << " to graph 1, first "
                         << r.at_draft->draft << " nohead lc rgb '#3070c0'\n";
  script << "plot 'body_plan.txt' with lines lw 1.5 lc rgb '#303030'\n";
  if (r.intact) {
    std::ofstream gz(folder / "gz.txt");
    gz << "# heel deg, GZ m: intact";
    if (r.damaged) gz << "; after two blank lines: with the flooded compartments open";
    gz << '\n';
    for (const auto& [heel, lever] : r.intact->righting) gz << heel / degree << ' ' << lever << '\n';
    if (r.damaged) {
      gz << "\n\n";
      for (const auto& [heel, lever] : r.damaged->righting) gz << heel / degree << ' ' << lever << '\n';
    }
    gz.close();
    script << "unset arrow 1\nset output 'gz.png'\nset size noratio\nset key top left\nset xlabel 'heel [deg]'\n"
           << "set ylabel 'GZ [m]'\nset xzeroaxis\n"
           << "plot 'gz.txt' index 0 with lines lw 2 title 'intact'";
    if (r.damaged) script << ", 'gz.txt' index 1 with lines lw 2 title 'compartments open'";
    script << '\n';
  }
  script.close();
  run_gnuplot(folder, "hull.gp");
}

}  // namespace

sim::Case case_of_hull_file(const std::string& file, const HullOptions& options) {
  sim::Case c;
  c.dim = 3;
  c.hull.offsets_file = fs::absolute(file).string();
  c.hull.station = options.amidships;
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".csv") {
    c.hull.shape = sim::Hull::Shape::offsets_hull;
    c.hull.scale = options.scale;
  } else if (ending == ".stl" || ending == ".STL") {
    c.hull.shape = sim::Hull::Shape::stl;
    c.hull.unit = options.unit;
  } else {
    fail(ErrorCode::invalid_argument, "{}: what is it? Allowed: a case (.yaml), a table of half-breadths (.csv), .stl",
         file);
  }
  c.body.draft = options.draft;
  c.body.cog = {0, 0, options.kg};
  return c;
}

int print_hull(const sim::Case& c, const HullOptions& options) {
  if (c.hull.shape == sim::Hull::Shape::none) fail(ErrorCode::invalid_argument, "the case has no hull");
  if (c.dim != 3)
    fail(ErrorCode::invalid_argument, "the case is a section; `seaway-run check` prints its hydrostatics");
  const hull::Ship ship = hull::build_ship(sim::ship_spec(c.hull, c.folder));
  sim::LoadCondition load;
  load.draft = c.body.draft;
  load.mass = c.body.mass;
  load.rho = c.fluids.rho_water;
  load.open = sim::open_compartments(c.hull);
  if (c.body.mass > 0) {
    load.cog = c.body.cog;
  } else if (c.body.cog.z() > 0 && c.body.draft > 0) {  // a bare file: the ship floats on even keel
    const auto water = hull::hydrostatics({{ship.outer, 1.0}}, {c.body.draft, 0, 0});
    load.cog = Vec3(water.buoyancy_centre.x(), 0, c.body.cog.z());
  }
  const sim::ShipReport report = sim::ship_report(ship, load);
  if (options.json)
    std::printf("%s\n", to_json(report).dump().c_str());
  else
    print_text(report);
  if (!options.folder.empty()) {
    draw(ship, report, options.folder);
    if (!options.json)
      std::printf("\nwrote %s/body_plan.png%s\n", options.folder.c_str(), report.intact ? " and gz.png" : "");
  }
  return 0;
}

}  // namespace seaway::server
