#include "core/sim/check_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>

#include "tests/unit/core/sim/example_case.hpp"

namespace seaway::sim {
namespace {

using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

std::string listing(const CaseReport& report) {
  std::string text;
  for (const Diagnostic& d : report.diagnostics)
    text += (d.severity == Diagnostic::Severity::error ? "error " : "warning ") + d.field + ": " +
            d.message + "; " + d.hint + "\n";
  return text;
}

struct Fault {
  const char* name;
  std::function<void(Case&)> make;
  const char* field;
  const char* message;
  Diagnostic::Severity severity = Diagnostic::Severity::error;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

constexpr auto warning = Diagnostic::Severity::warning;

class CheckCaseFault : public ::testing::TestWithParam<Fault> {};

TEST_P(CheckCaseFault, IsNamedByFieldAndValue) {
  Case c = damaged_section_in_waves();
  GetParam().make(c);
  const CaseReport report = check_case(c);
  bool found = false;
  for (const Diagnostic& d : report.diagnostics) {
    EXPECT_FALSE(d.message.empty() || d.hint.empty() || d.field.empty());
    found = found || (d.field == GetParam().field && d.severity == GetParam().severity &&
                      d.message.find(GetParam().message) != std::string::npos);
  }
  EXPECT_TRUE(found) << "expected " << GetParam().field << ": " << GetParam().message << "\ngot:\n"
                     << listing(report);
  EXPECT_EQ(report.ok(), GetParam().severity == warning) << listing(report);
}

void make_polygon(Case& c, std::vector<std::array<double, 2>> vertices) {
  c.hull = {};
  c.hull.shape = Hull::Shape::polygon;
  c.hull.vertices = std::move(vertices);
}

const Fault faults[] = {
    {"Dimension", [](Case& c) { c.dim = 4; }, "dimension", "4"},
    {"NegativeMass", [](Case& c) { c.body.mass = -1; }, "body.mass_kg_per_m", "-1"},
    {"NanMass", [](Case& c) { c.body.mass = nan; }, "body.mass_kg_per_m", "nan"},
    {"ZeroInertia", [](Case& c) { c.body.gyradii.x() = 0; }, "body.gyradii.x_m", "0"},
    {"NanCog", [](Case& c) { c.body.cog.z() = nan; }, "body.cog.z_m", "nan"},
    {"InfiniteOffset", [](Case& c) { c.body.offset.z() = inf; }, "body.offset.z_m", "inf"},
    {"FreeAndPrescribed",
     [](Case& c) {
       c.body.prescribed = {{Dof::roll, 0.1, 1.0, 0.0}};
     },
     "body.prescribed[0].dof", "roll is both free and prescribed"},
    {"NoPitchInSection", [](Case& c) { c.body.free.push_back(Dof::pitch); }, "body.free[2]",
     "no pitch"},
    {"FreeTwice", [](Case& c) { c.body.free.push_back(Dof::roll); }, "body.free[2]", "twice"},
    {"TooHeavy", [](Case& c) { c.body.mass = 200; }, "body.mass_kg_per_m", "200 kg/m cannot float"},
    {"DraftAboveHull", [](Case& c) { c.body.draft = 0.5; }, "body.draft_m", "0.5 m cannot float"},
    {"OtherDraft", [](Case& c) { c.body.draft = 0.10; }, "body.draft_m", "not where it floats",
     warning},
    {"Unstable", [](Case& c) { c.body.cog.z() = 0.2; }, "body.cog.z_m", "not stable", warning},
    {"OffCentre", [](Case& c) { c.body.cog.y() = 0.005; }, "body.cog.y_m", "does not float upright",
     warning},
    {"OpenPolygon",
     [](Case& c) {
       make_polygon(c, {{-0.2, 0}, {0.2, 0}, {0.2, 0.3}, {-0.2, 0.3}});
     },
     "hull.polygon.vertices", "polygon is open"},
    {"CrossedPolygon",
     [](Case& c) {
       make_polygon(c, {{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}});
     },
     "hull.polygon.vertices", "crosses"},
    {"NanPolygon",
     [](Case& c) {
       make_polygon(c, {{0, 0}, {1, nan}, {1, 1}, {0, 0}});
     },
     "hull.polygon.vertices", "nan"},
    {"NoOffsetsFile", [](Case& c) { c.hull.offsets_file = "absent.csv"; },
     "hull.offsets_section.file", "absent.csv"},
    {"StationOutside", [](Case& c) { c.hull.station = 500; }, "hull.offsets_section", "x = 500"},
    {"ZeroScale", [](Case& c) { c.hull.scale = 0; }, "hull.offsets_section.scale", "0"},
    {"ThinWall", [](Case& c) { c.hull.compartments[1].wall_thickness = 0.015; },
     "hull.compartments", "thinner than 2 cells of 0.01 m", warning},
    {"DryBehindThinWalls",
     [](Case& c) {
       c.hull.compartments[1].wall_thickness = 0.015;
       c.hull.compartments[1].flooded = false;
     },
     "hull.compartments[1]", "starts dry, behind walls thinner than 2 cells", warning},
    {"CoarseHullCell", [](Case& c) { c.stages[0].mesh.hull_cell = 0.02; },
     "hull.compartments", "2 cells of 0.02 m", warning},
    {"NarrowCompartment",
     [](Case& c) {
       c.stages[0].mesh.hull_cell = 0.04;
       for (SurfaceBand& band : c.stages[0].mesh.surface) band.cell = 0.04;
     },
     "hull.compartments[0].y_m", "less than 4 cells of 0.04 m"},
    {"ThinBulkhead",
     [](Case& c) {
       c.hull.compartments[0].lower.y() = 0.005;
       c.hull.compartments[1].upper.y() = -0.005;
       c.body.mass = 15;  // with so much of it flooded
     },
     "hull.compartments", "thinner than 2 cells of 0.01 m", warning},
    {"Permeability", [](Case& c) { c.hull.compartments[0].permeability = 1.2; },
     "hull.compartments[0].permeability", "1.2"},
    {"ZeroPermeability", [](Case& c) { c.hull.compartments[0].permeability = 0; },
     "hull.compartments[0].permeability", "above 0"},
    {"OpeningAfar",
     [](Case& c) {
       c.hull.compartments[0].openings[0].lower.z() = 0.4;
       c.hull.compartments[0].openings[0].upper.z() = 0.5;
     },
     "hull.compartments[0].openings[0]", "touches no wall"},
    {"OpeningUpsideDown", [](Case& c) { c.hull.compartments[0].openings[0].upper.z() = 0.01; },
     "hull.compartments[0].openings[0].z_m", "0.07 to 0.01"},
    {"CompartmentOutside",
     [](Case& c) {
       c.hull.compartments[0].lower.y() = 0.3;
       c.hull.compartments[0].upper.y() = 0.4;
     },
     "hull.compartments[0]", "outside the hull"},
    {"FloodedButClosed", [](Case& c) { c.hull.compartments[0].openings.clear(); },
     "hull.compartments[0].openings", "flooded but closed", warning},
    {"HullOutsideTank", [](Case& c) { c.body.offset.y() = 9.5; }, "tank.y_m", "outside the tank"},
    {"HullBelowBottom", [](Case& c) { c.body.offset.z() = -2.75; }, "tank.z_m", "outside the tank"},
    {"HullInZone", [](Case& c) { c.body.offset.y() = -8.2; }, "zones", "stands in a zone"},
    {"NanTank", [](Case& c) { c.tank.lower.z() = nan; }, "tank.z_m", "nan"},
    {"NoWaterInTank", [](Case& c) { c.tank.lower.z() = 0.1; }, "tank.z_m", "calm water level"},
    {"Breaking", [](Case& c) { c.wave.height = 0.5; }, "wave.regular.height_m", "0.5 m breaks"},
    {"NegativeHeight", [](Case& c) { c.wave.height = -0.1; }, "wave.regular.height_m", "-0.1"},
    {"BothPeriodAndLength", [](Case& c) { c.wave.length = 3.0; }, "wave.regular.period_s", "both"},
    {"NeitherPeriodNorLength", [](Case& c) { c.wave.period = 0; }, "wave.regular.period_s",
     "neither"},
    {"NegativePeriod", [](Case& c) { c.wave.period = -1.4; }, "wave.regular.period_s", "-1.4"},
    {"ObliqueWave", [](Case& c) { c.wave.heading = 0.5; }, "wave.regular.heading_deg", "28.6"},
    {"LongWave", [](Case& c) { c.wave.period = 4.5; }, "tank.y_m", "one wave must fit"},
    {"LowLid", [](Case& c) { c.tank.upper.z() = 0.04; }, "tank.z_m", "too low for crests"},
    {"PeriodicMismatch",
     [](Case& c) {
       c.zones = {};
       c.tank.periodic[1] = true;
       c.wave.period = 0;
       c.wave.length = 3.0;
     },
     "tank.y_m", "whole number"},
    {"SteepAiry",
     [](Case& c) {
       c.wave.theory = Wave::Theory::airy;
       c.wave.height = 0.1;
     },
     "wave.regular.theory", "linear theory", warning},
    {"LongZones", [](Case& c) { c.zones.absorption_length = 18; }, "zones.absorption_length_m",
     "19.6 m together"},
    {"ShortBeach", [](Case& c) { c.zones.absorption_length = 1; }, "zones.absorption_length_m",
     "shorter than", warning},
    {"NoRootCell", [](Case& c) { c.base_cell = 0; }, "mesh.base_cell_m", "above 0"},
    {"HugeRootCell", [](Case& c) { c.base_cell = 5; }, "mesh.base_cell_m", "shorter side"},
    {"NoStages", [](Case& c) { c.stages.clear(); }, "cascade.stages", "0 stages"},
    {"StageNamesRepeat", [](Case& c) { c.stages[1].name = "A"; }, "cascade.stages[1].name",
     "used twice"},
    {"NegativeCell", [](Case& c) { c.stages[1].mesh.hull_cell = -0.01; },
     "cascade.stages[1].mesh.hull_cell_m", "-0.01"},
    {"BandBelowTheHullsCells", [](Case& c) { c.stages[2].mesh.surface[0].cell = 0.4 * c.stages[2].mesh.hull_cell; },
     "cascade.stages[2].mesh.surface[0].cell_m", "finer than those at the hull"},
    {"BoxBelowTheHullsCells",
     [](Case& c) { c.stages[0].mesh.boxes.push_back({0.4 * c.stages[0].mesh.hull_cell, {0, -1, -0.1}, {0, -0.9, 0.1}}); },
     "cascade.stages[0].mesh.boxes[0].cell_m", "finer than those at the hull"},
    {"CoarseFinestBand",
     [](Case& c) {
       c.stages[2].mesh.hull_cell = 0;
       c.stages[2].mesh.surface[0].cell = 0.02;
       c.hull.compartments.clear();
     },
     "cascade.stages[2].mesh.surface", "cells of 0.02 m per wave height"},
    {"CoarseFirstBand",
     [](Case& c) {
       c.stages[0].mesh.hull_cell = 0;
       c.hull.compartments.clear();
     },
     "cascade.stages[0].mesh.surface", "cells of 0.02 m per wave height", warning},
    {"EndlessStage", [](Case& c) { c.body.free.clear(); }, "cascade.stages[0].end.converged",
     "never end"},
    {"NoDuration", [](Case& c) { c.stages[0].end = {}; }, "cascade.stages[0].end.time.duration_s",
     "0"},
    {"InfinitePeriods", [](Case& c) { c.stages[0].end.max_periods = inf; },
     "cascade.stages[0].end.converged.max_periods", "inf"},
    {"ZeroTolerance", [](Case& c) { c.stages[0].end.tolerance = 0; },
     "cascade.stages[0].end.converged.tolerance", "above 0"},
    {"Cfl", [](Case& c) { c.time.cfl = 1; }, "time.cfl", "at most 0.5"},
    {"NanStep", [](Case& c) { c.time.dt = nan; }, "time.dt_s", "nan"},
    {"GaugeOutside",
     [](Case& c) {
       c.outputs.gauges = {{"g1", 0, 20}};
     },
     "outputs.gauges[0].y_m", "20"},
    {"AirHeavierThanWater", [](Case& c) { c.fluids.rho_air = 2000; },
     "fluids.air_density_kg_per_m3", "2000"},
    {"MappingSubsets", [](Case& c) { c.stages[1].mapping.k = 0; }, "cascade.stages[1].mapping.k",
     "0"},
};

INSTANTIATE_TEST_SUITE_P(BadInput, CheckCaseFault, ::testing::ValuesIn(faults),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(CheckCase, ExampleIsGood) {
  const CaseReport report = check_case(damaged_section_in_waves());
  EXPECT_TRUE(report.ok()) << listing(report);
  EXPECT_TRUE(report.diagnostics.empty()) << listing(report);
  const HydrostaticsSummary& h = report.hydrostatics;
  ASSERT_TRUE(h.valid);
  EXPECT_NEAR(h.draft, 0.147, 0.001);  // asked for: about 0.147 and 0.039
  EXPECT_NEAR(h.gm, 0.039, 0.0015);
  EXPECT_NEAR(h.heel, 0.0, 1e-12);
  EXPECT_NEAR(h.intact_draft, 6.15 / 51, 1e-4);
  EXPECT_NEAR(h.displaced_volume, 0.0367, 1e-9);
  EXPECT_NEAR(h.natural_roll_period_dry, 2 * pi * 0.12 / std::sqrt(9.81 * h.gm), 1e-12);
}

TEST(CheckCase, CostGrowsFromStageToStage) {
  const CaseReport report = check_case(damaged_section_in_waves());
  ASSERT_EQ(report.stages.size(), 3u);
  for (const StageEstimate& e : report.stages) {
    std::printf("%s: %lld cells, %lld steps of %.4f s, %.0f CPU s\n", e.name.c_str(),
                static_cast<long long>(e.cells), static_cast<long long>(e.steps), e.dt, e.cpu_s);
    EXPECT_GT(e.steps, 100);
  }
  EXPECT_GT(report.stages[1].cells, report.stages[0].cells);
  EXPECT_GT(report.stages[2].cells, report.stages[1].cells);
}

TEST(CheckCase, CountsUniformMeshExactly) {
  Case c;
  c.tank.lower = {0, -1.6, -0.8};
  c.tank.upper = {0, 1.6, 0.8};
  c.base_cell = 0.05;
  c.time.dt = 0.01;
  c.stages.resize(1);
  c.stages[0].end.duration = 1.0;
  const CaseReport report = check_case(c);
  ASSERT_TRUE(report.ok()) << listing(report);
  EXPECT_EQ(report.stages[0].cells, 64 * 32);
  EXPECT_EQ(report.stages[0].steps, 100);
  EXPECT_NEAR(report.stages[0].cpu_s, 64 * 32 * 100 / 2.4e6, 1e-9);
}

TEST(CheckCase, CalmWaterWithoutMotionNeedsTimeStep) {
  Case c;
  c.tank.lower = {0, -1, -1};
  c.tank.upper = {0, 1, 1};
  c.base_cell = 0.05;
  c.stages.resize(1);
  c.stages[0].end.duration = 1.0;
  const CaseReport report = check_case(c);
  ASSERT_EQ(report.diagnostics.size(), 1u) << listing(report);
  EXPECT_EQ(report.diagnostics[0].field, "time.dt_s");
}

TEST(CheckCase, SinkingBodyMayBeStartedByDraft) {
  Case c = damaged_section_in_waves();
  c.hull = {};
  c.hull.shape = Hull::Shape::box;
  c.hull.beam = 0.3;
  c.hull.height = 0.1;
  c.body.mass = 60;
  c.body.draft = 0.1;
  c.body.offset.z() = -0.3;
  c.body.cog.z() = 0.05;
  const CaseReport report = check_case(c);
  EXPECT_TRUE(report.ok()) << listing(report);
  EXPECT_THAT(listing(report), HasSubstr("it will sink"));
}

TEST(CheckCase, ManyFaultsAreAllReported) {
  Case c = damaged_section_in_waves();
  c.body.mass = -1;
  c.time.cfl = 7;
  c.wave.height = nan;
  EXPECT_GE(check_case(c).diagnostics.size(), 3u);
}

}  // namespace
}  // namespace seaway::sim
