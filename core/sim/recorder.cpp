#include "core/sim/recorder.hpp"

namespace seaway::sim {

template <int Dim>
Recorder<Dim>::Recorder(const Model<Dim>& model) {
  const bool section = Dim == 2;
  if (model.hull) {
    for (int dof = 0; dof < 6; ++dof) {
      const int i = motion::dof_index<Dim>(static_cast<motion::Dof>(dof));
      if (i < 0) continue;
      if (model.free[static_cast<std::size_t>(i)]) free_motions_.push_back(channels_.size());
      motions_.push_back(channels_.size());
      channels_.push_back({motion::dof_names[static_cast<std::size_t>(dof)], dof < 3 ? "m" : "rad"});
    }
    const char* loads[6] = {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
    for (int dof = 0; dof < 6; ++dof) {
      if (motion::dof_index<Dim>(static_cast<motion::Dof>(dof)) < 0) continue;
      if (dof == 2 || dof == 3) release_loads_.push_back(channels_.size());
      channels_.push_back({loads[dof], dof < 3 ? (section ? "N/m" : "N") : (section ? "N" : "N m")});
    }
    if (model.wall_model != flow::WallModel::slip) {
      const char* friction[6] = {"friction_x", "friction_y", "friction_z",
                                 "friction_moment_x", "friction_moment_y", "friction_moment_z"};
      for (int dof = 0; dof < 6; ++dof)
        if (motion::dof_index<Dim>(static_cast<motion::Dof>(dof)) >= 0)
          channels_.push_back({friction[dof], dof < 3 ? (section ? "N/m" : "N") : (section ? "N" : "N m")});
    }
  }
  const char* volume = section ? "m2" : "m3";
  channels_.push_back({"water_volume", volume});
  channels_.push_back({"water_exchanged", volume});
  channels_.push_back({"water_owed", volume});
  channels_.push_back({"mean_level", "m"});
  for (const std::string& name : model.compartments) channels_.push_back({"compartment." + name + ".volume", volume});
  for (const Gauge& gauge : model.description.outputs.gauges) channels_.push_back({"gauge." + gauge.name, "m"});
  for (const Probe& probe : model.description.outputs.probes) channels_.push_back({"pressure." + probe.name, "Pa"});
  channels_.push_back({"courant", "1"});
  channels_.push_back({"pressure_iterations", "1"});
}

template <int Dim>
std::vector<double> Recorder<Dim>::values(const Simulation<Dim>& s, const StepReport& step,
                                          double initial_water) const {
  std::vector<double> out;
  out.reserve(channels_.size());
  const Model<Dim>& model = s.model();
  if (model.hull) {
    const auto displacement = motion::displacement<Dim>(s.body().pose, model.rest_cog);
    for (int i = 0; i < motion::n_dof<Dim>; ++i) out.push_back(displacement[i]);
    for (int i = 0; i < motion::n_dof<Dim>; ++i) out.push_back(s.load()[i]);
    if (model.wall_model != flow::WallModel::slip)
      for (int i = 0; i < motion::n_dof<Dim>; ++i) out.push_back(s.friction()[i]);
  }
  const WaterBalance water = s.water();
  double area = 1;
  for (int a = 0; a + 1 < Dim; ++a) area *= model.grid.upper[a] - model.grid.lower[a];
  out.push_back(water.visible);
  out.push_back(water.exchanged);
  out.push_back(water.reservoir);
  out.push_back((water.visible - initial_water) / area);
  for (const double v : s.compartment_volumes()) out.push_back(v);
  for (const Gauge& gauge : model.description.outputs.gauges) out.push_back(s.elevation(gauge.x, gauge.y));
  for (const Probe& probe : model.description.outputs.probes) out.push_back(s.pressure(probe));
  out.push_back(step.courant);
  out.push_back(step.pressure.iterations);
  return out;
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace seaway::sim
