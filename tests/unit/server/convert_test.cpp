// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/yaml.hpp"
#include "server/convert/case.hpp"
#include "server/convert/input_error.hpp"
#include "server/convert/result.hpp"

namespace seaway::convert {
namespace {

using ::testing::HasSubstr;

v1::Case small() {
  v1::Case m;
  yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", m);
  return m;
}

std::vector<std::string> refused_fields(const v1::Case& m) {
  std::vector<std::string> out;
  try {
    to_core(m);
  } catch (const InputError& error) {
    for (const auto& p : error.problems()) out.push_back(p.field);
  }
  return out;
}

TEST(ConvertCase, AppliesUnitsAndDefaults) {
  v1::Case m = small();
  m.mutable_wave()->mutable_regular()->set_phase_deg(90);
  m.mutable_body()->mutable_angles()->set_roll_deg(-15);
  const sim::Case c = to_core(m);
  EXPECT_EQ(c.dim, 2);
  EXPECT_DOUBLE_EQ(c.wave.phase, pi / 2);
  EXPECT_DOUBLE_EQ(c.wave.heading, pi / 2);
  EXPECT_DOUBLE_EQ(c.body.angles[0], -15 * degree);
  EXPECT_EQ(c.fluids.rho_water, 1000);
  EXPECT_EQ(c.tank.lower[1], -3.5);
  EXPECT_EQ(c.hull.compartments.at(0).openings.at(0).upper[2], 0.05);
  EXPECT_EQ(c.body.release, sim::Body::Release::converged);
  ASSERT_EQ(c.stages.size(), 3u);
  EXPECT_EQ(c.stages[0].mesh.surface[0].within, std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.stages[2].mesh.surface[0].within, 2);
  EXPECT_DOUBLE_EQ(c.stages[0].mesh.hull_sweep, 35 * degree);
  EXPECT_EQ(c.body.free, (std::vector<sim::Dof>{sim::Dof::heave, sim::Dof::roll}));
}

TEST(ConvertCase, WritesEveryDefaultOut) {
  const v1::Case full = to_proto(to_core(small()));
  EXPECT_EQ(full.fluids().gravity_m_per_s2(), 9.81);
  EXPECT_EQ(full.wave().regular().theory(), v1::RegularWave::THEORY_STREAM_FUNCTION);
  const v1::Case again = to_proto(to_core(full));
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(full, again))
      << full.DebugString() << again.DebugString();
}

TEST(ConvertCase, TurbulenceAndNoSlipSidesGoThereAndBack) {
  v1::Case m = small();
  EXPECT_EQ(to_core(m).turbulence.model, sim::Turbulence::Model::none);
  EXPECT_FALSE(to_proto(to_core(m)).has_turbulence());
  m.mutable_turbulence()->set_intensity(0.05);
  v1::NoSlipSide& lid = *m.mutable_tank()->add_no_slip();
  lid.set_side(v1::TANK_SIDE_BOTTOM);
  lid.set_velocity_y_m_per_s(0.5);
  const sim::Case c = to_core(m);
  EXPECT_EQ(c.turbulence.model, sim::Turbulence::Model::stabilised);
  EXPECT_EQ(c.turbulence.walls, sim::Turbulence::Walls::wall_function);
  EXPECT_EQ(c.turbulence.intensity, 0.05);
  ASSERT_EQ(c.tank.no_slip.size(), 1u);
  EXPECT_EQ(c.tank.no_slip[0].axis, 2);
  EXPECT_FALSE(c.tank.no_slip[0].upper);
  EXPECT_EQ(c.tank.no_slip[0].velocity.y(), 0.5);
  const v1::Case full = to_proto(c);
  EXPECT_EQ(full.turbulence().length_scale_m(), 0.005);
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(full, to_proto(to_core(full))));
}

TEST(ConvertCase, StepsOfStagesGoThereAndBack) {
  v1::Case m = small();
  m.mutable_cascade()->mutable_stages(0)->mutable_time()->set_steps_per_period(60);
  m.mutable_cascade()->mutable_stages(1)->mutable_time()->set_dt_s(0.005);
  const sim::Case c = to_core(m);
  EXPECT_EQ(c.stages[0].steps_per_period, 60);
  EXPECT_EQ(c.stages[1].dt, 0.005);
  EXPECT_EQ(c.stages[2].dt, 0);
  EXPECT_EQ(c.stages[2].steps_per_period, 0);
  const v1::Case full = to_proto(c);
  EXPECT_EQ(full.cascade().stages(0).time().steps_per_period(), 60);
  EXPECT_EQ(full.cascade().stages(1).time().dt_s(), 0.005);
  EXPECT_FALSE(full.cascade().stages(2).has_time());
}

struct Mistake {
  const char* field;
  void (*make)(v1::Case&);
};
class Mistakes : public ::testing::TestWithParam<Mistake> {};
TEST_P(Mistakes, AreRefusedByField) {
  v1::Case m = small();
  GetParam().make(m);
  EXPECT_THAT(refused_fields(m), ::testing::Contains(GetParam().field));
}
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    ConvertCase, Mistakes,
    ::testing::Values(
        Mistake{"turbulence.intensity", [](v1::Case& m) { m.mutable_turbulence()->set_intensity(2); }},
        Mistake{"turbulence.length_scale_m",
                [](v1::Case& m) {
                  m.mutable_turbulence()->set_model(v1::Turbulence::MODEL_LAMINAR);
                  m.mutable_turbulence()->set_length_scale_m(1);
                }},
        Mistake{"tank.no_slip[0].side", [](v1::Case& m) { m.mutable_tank()->add_no_slip(); }},
        Mistake{"title", [](v1::Case& m) { m.clear_title(); }},
        Mistake{"dimension", [](v1::Case& m) { m.set_dimension(4); }},
        Mistake{"tank", [](v1::Case& m) { m.clear_tank(); }},
        Mistake{"tank.x_m", [](v1::Case& m) { m.mutable_tank()->add_x_m(1); }},
        Mistake{"tank.y_m", [](v1::Case& m) { m.mutable_tank()->add_y_m(1); }},
        Mistake{"tank.z_m", [](v1::Case& m) { m.mutable_tank()->set_z_m(0, 0.1); }},
        Mistake{"mesh.base_cell_m", [](v1::Case& m) { m.clear_mesh(); }},
        Mistake{"mesh.base_cell_m", [](v1::Case& m) { m.mutable_mesh()->set_base_cell_m(nan_value); }},
        Mistake{"wave", [](v1::Case& m) { m.mutable_wave()->clear_regular(); }},
        Mistake{"wave.regular", [](v1::Case& m) { m.mutable_wave()->mutable_regular()->set_length_m(3); }},
        Mistake{"wave.regular", [](v1::Case& m) { m.mutable_wave()->mutable_regular()->set_frequency_hz(0.7); }},
        Mistake{"wave.regular.height_m", [](v1::Case& m) { m.mutable_wave()->mutable_regular()->set_height_m(-1); }},
        Mistake{"wave.regular.heading_deg", [](v1::Case& m) { m.mutable_wave()->mutable_regular()->set_heading_deg(180); }},
        Mistake{"hull", [](v1::Case& m) { m.mutable_hull()->clear_box(); }},
        Mistake{"hull.box.beam_m", [](v1::Case& m) { m.mutable_hull()->mutable_box()->set_beam_m(0); }},
        Mistake{"hull.stl.unit_m", [](v1::Case& m) { m.mutable_hull()->mutable_stl()->set_file("hull.stl"); }},
        Mistake{"hull.stl.file", [](v1::Case& m) { m.mutable_hull()->mutable_stl()->set_unit_m(0.001); }},
        Mistake{"hull", [](v1::Case& m) { m.mutable_hull()->mutable_wigley(); }},
        Mistake{"hull.compartments[0].wall_thickness_m",
                [](v1::Case& m) { m.mutable_hull()->mutable_compartments(0)->clear_wall_thickness_m(); }},
        Mistake{"hull.compartments[0].permeability",
                [](v1::Case& m) { m.mutable_hull()->mutable_compartments(0)->set_permeability(1.2); }},
        Mistake{"hull.compartments[0].openings[0].y_m",
                [](v1::Case& m) { m.mutable_hull()->mutable_compartments(0)->mutable_openings(0)->clear_y_m(); }},
        Mistake{"hull.compartments[1].name",
                [](v1::Case& m) { *m.mutable_hull()->add_compartments() = m.hull().compartments(0); }},
        Mistake{"hull.compartments[0].name",
                [](v1::Case& m) { m.mutable_hull()->mutable_compartments(0)->set_name("../up"); }},
        Mistake{"body", [](v1::Case& m) { m.clear_body(); }},
        Mistake{"body", [](v1::Case& m) { m.clear_hull(); }},
        Mistake{"body.mass_kg_per_m", [](v1::Case& m) { m.mutable_body()->set_mass_kg_per_m(-15); }},
        Mistake{"body.mass_kg_per_m", [](v1::Case& m) { m.mutable_body()->set_mass_kg(15); }},
        Mistake{"body.cog", [](v1::Case& m) { m.mutable_body()->clear_cog(); }},
        Mistake{"body.gyradii.x_m", [](v1::Case& m) { m.mutable_body()->clear_gyradii(); }},
        Mistake{"body.free[2]", [](v1::Case& m) { m.mutable_body()->add_free(v1::DOF_PITCH); }},
        Mistake{"body.free[2]", [](v1::Case& m) { m.mutable_body()->add_free(v1::DOF_ROLL); }},
        Mistake{"body.free[2]", [](v1::Case& m) { m.mutable_body()->add_free(static_cast<v1::Dof>(77)); }},
        Mistake{"body.prescribed[0].dof",
                [](v1::Case& m) { m.mutable_body()->add_prescribed()->set_dof(v1::DOF_ROLL); }},
        Mistake{"body.release.converged.max_periods",
                [](v1::Case& m) { m.mutable_body()->mutable_release()->mutable_converged()->set_max_periods(1); }},
        Mistake{"time.steps_per_period", [](v1::Case& m) { m.mutable_time()->set_steps_per_period(100); }},
        Mistake{"cascade.stages[1].time.dt_s",
                [](v1::Case& m) { m.mutable_cascade()->mutable_stages(1)->mutable_time()->set_dt_s(-0.01); }},
        Mistake{"cascade.stages[1].time.steps_per_period",
                [](v1::Case& m) { m.mutable_cascade()->mutable_stages(1)->mutable_time()->set_steps_per_period(5); }},
        Mistake{"cascade.stages[1].time.steps_per_period",
                [](v1::Case& m) {
                  m.mutable_cascade()->mutable_stages(1)->mutable_time()->set_dt_s(0.01);
                  m.mutable_cascade()->mutable_stages(1)->mutable_time()->set_steps_per_period(60);
                }},
        Mistake{"cascade.stages", [](v1::Case& m) { m.clear_cascade(); }},
        Mistake{"cascade.stages[1].end", [](v1::Case& m) { m.mutable_cascade()->mutable_stages(1)->clear_end(); }},
        Mistake{"cascade.stages[0].mapping", [](v1::Case& m) { m.mutable_cascade()->mutable_stages(0)->mutable_mapping(); }},
        Mistake{"cascade.stages[2].mapping.k",
                [](v1::Case& m) { m.mutable_cascade()->mutable_stages(2)->mutable_mapping()->set_k(120); }},
        Mistake{"outputs.gauges[1].name",
                [](v1::Case& m) { m.mutable_outputs()->add_gauges()->set_name("bow"); }}));

TEST(ConvertCase, ReadsSeasAndWritesThemBack) {
  v1::Case m = small();
  auto& sea = *m.mutable_wave()->mutable_irregular();
  sea.mutable_spectrum()->set_shape(v1::WaveSpectrum::SHAPE_JONSWAP);
  sea.mutable_spectrum()->set_peak_period_s(1.4);
  sea.set_significant_height_m(0.05);
  sea.set_seed(7);
  sea.set_heading_deg(-90);
  const sim::Case core = to_core(m);
  EXPECT_EQ(core.wave.kind, sim::Wave::Kind::irregular);
  EXPECT_EQ(core.wave.spectrum.components, 100);
  EXPECT_EQ(core.wave.spectrum.peak_enhancement, 3.3);
  EXPECT_DOUBLE_EQ(core.wave.heading, -pi / 2);
  const auto full = to_proto(core).wave().irregular();
  EXPECT_EQ(full.seed(), 7u);
  EXPECT_EQ(full.spectrum().shape(), v1::WaveSpectrum::SHAPE_JONSWAP);
  EXPECT_EQ(full.spectrum().upper_cutoff(), 2.5);
  EXPECT_EQ(full.significant_height_m(), 0.05);
  auto& group = *m.mutable_wave()->mutable_focused();
  group.mutable_spectrum()->set_shape(v1::WaveSpectrum::SHAPE_PIERSON_MOSKOWITZ);
  group.mutable_spectrum()->set_peak_period_s(1.4);
  group.set_amplitude_m(-0.04);
  group.set_focus_time_s(8);
  EXPECT_EQ(to_proto(to_core(m)).wave().focused().amplitude_m(), -0.04);
  EXPECT_EQ(to_core(m).wave.time, 8);
  auto& series = *m.mutable_wave()->mutable_time_series();
  series.set_file("gauge.csv");
  series.set_lower_cutoff_hz(0.3);
  series.set_upper_cutoff_hz(2);
  EXPECT_EQ(to_core(m).wave.file, "gauge.csv");
  EXPECT_EQ(to_proto(to_core(m)).wave().time_series().upper_cutoff_hz(), 2);
}

TEST(ConvertCase, RefusesSeasThatSayTooMuchOrTooLittle) {
  const auto why = [](const std::function<void(v1::IrregularWave&)>& change) {
    v1::Case m = small();
    auto& sea = *m.mutable_wave()->mutable_irregular();
    sea.mutable_spectrum()->set_shape(v1::WaveSpectrum::SHAPE_BRETSCHNEIDER);
    sea.mutable_spectrum()->set_peak_period_s(1.4);
    sea.set_significant_height_m(0.05);
    change(sea);
    try {
      to_core(m);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(why([](auto&) {}), "accepted");
  EXPECT_THAT(why([](auto& s) { s.mutable_spectrum()->clear_shape(); }), HasSubstr("wave.irregular.spectrum.shape: is missing"));
  EXPECT_THAT(why([](auto& s) { s.mutable_spectrum()->set_shape(v1::WaveSpectrum::SHAPE_PIERSON_MOSKOWITZ); }),
              HasSubstr("wave.irregular.significant_height_m: is fixed by the peak period"));
  EXPECT_THAT(why([](auto& s) { s.clear_significant_height_m(); }), HasSubstr("significant_height_m: is missing"));
  EXPECT_THAT(why([](auto& s) { s.mutable_spectrum()->set_peak_enhancement(2); }), HasSubstr("has no effect on this spectrum"));
  EXPECT_THAT(why([](auto& s) { s.mutable_spectrum()->clear_peak_period_s(); }), HasSubstr("peak_period_s: is missing"));
  EXPECT_THAT(why([](auto& s) { s.mutable_spectrum()->set_component_count(9); }), HasSubstr("component_count"));
  EXPECT_THAT(why([](auto& s) { s.set_heading_deg(45); }), HasSubstr("not possible in a section"));
}

TEST(ConvertCase, ReadsProbesAndWritesThemBack) {
  v1::Case m = small();
  auto& bow = *m.mutable_outputs()->add_probes();
  bow.set_name("bow");
  bow.set_y_m(0.1);
  bow.set_z_m(0.02);
  auto& wall = *m.mutable_outputs()->add_probes();
  wall.set_name("wall");
  wall.set_frame(v1::PressureProbe::FRAME_EARTH);
  wall.set_z_m(-0.5);
  const sim::Case core = to_core(m);
  ASSERT_EQ(core.outputs.probes.size(), 2u);
  EXPECT_TRUE(core.outputs.probes[0].on_hull);  // the default beside a hull
  EXPECT_EQ(core.outputs.probes[0].place, Vec3(0, 0.1, 0.02));
  EXPECT_FALSE(core.outputs.probes[1].on_hull);
  const v1::Case full = to_proto(core);
  EXPECT_EQ(full.outputs().probes(0).frame(), v1::PressureProbe::FRAME_HULL);
  EXPECT_EQ(full.outputs().probes(1).z_m(), -0.5);
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(full, to_proto(to_core(full))));
  m.mutable_outputs()->mutable_probes(1)->set_name("bow");
  EXPECT_THAT(refused_fields(m), ::testing::Contains("outputs.probes[1].name"));
  m.clear_hull();
  m.clear_body();
  m.mutable_outputs()->mutable_probes(0)->set_frame(v1::PressureProbe::FRAME_HULL);
  EXPECT_THAT(refused_fields(m), ::testing::Contains("outputs.probes[0].frame"));
}

TEST(ConvertCase, AFrequencyIsAPeriod) {
  v1::Case m = small();
  m.mutable_wave()->mutable_regular()->clear_period_s();
  m.mutable_wave()->mutable_regular()->set_frequency_hz(0.8);
  EXPECT_DOUBLE_EQ(to_core(m).wave.period, 1.25);
}

TEST(ConvertCase, RefusesOpenAndFlatPolygons) {
  v1::Case m = small();
  auto& polygon = *m.mutable_hull()->mutable_polygon();
  const auto add = [&](double y, double z) {
    polygon.add_vertices()->set_y_m(y);
    polygon.mutable_vertices(polygon.vertices_size() - 1)->set_z_m(z);
  };
  add(0, 0);
  add(0, 1);
  EXPECT_THAT(refused_fields(m), ::testing::Contains("hull.polygon.vertices"));
  add(0, 2);
  add(0, 0);
  EXPECT_THAT(refused_fields(m), ::testing::Contains("hull.polygon.vertices"));  // no area
  add(1, 1);
  EXPECT_THAT(refused_fields(m), ::testing::Contains("hull.polygon.vertices[4]"));  // open
}

TEST(ConvertCase, ReadsAnStlHull) {
  v1::Case m = small();
  m.set_dimension(3);
  auto& stl = *m.mutable_hull()->mutable_stl();
  stl.set_file("hull.stl");
  stl.set_unit_m(0.001);
  stl.set_amidships(1500);
  EXPECT_THAT(refused_fields(m), ::testing::Not(::testing::Contains(::testing::StartsWith("hull.stl"))));
}

TEST(ConvertResult, TurnsRadiansIntoDegreesAtTheEdge) {
  EXPECT_EQ(to_proto(sim::Channel{"roll", "rad"}).unit(), "deg");
  EXPECT_EQ(to_proto(sim::Channel{"roll_rate", "rad/s"}).unit(), "deg/s");
  EXPECT_EQ(to_proto(sim::Channel{"heave", "m"}).unit(), "m");
  v1::SampleChunk chunk;
  append({5, 1, 40, 0.5, {pi / 6, 0.25}}, {{"roll", "rad"}, {"heave", "m"}}, chunk);
  EXPECT_NEAR(chunk.columns(0).values(0), 30, 1e-13);  // rounding of pi
  EXPECT_EQ(chunk.columns(1).values(0), 0.25);
  EXPECT_EQ(chunk.first_sequence(), 5);
}

}  // namespace
}  // namespace seaway::convert
