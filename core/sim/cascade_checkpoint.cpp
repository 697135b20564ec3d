// Checkpoints of a run: written at intervals and at stage ends; the last two and all stage ends kept, the newest valid one
// used.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "core/io/checkpoint.hpp"
#include "core/sim/cascade_run.hpp"
#include "core/sim/checkpoint_name.hpp"

namespace seaway::sim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* prefix = "checkpoint_";

template <int Dim>
std::vector<double> numbers(const motion::Pose<Dim>& pose) {
  std::vector<double> out(pose.cog.data(), pose.cog.data() + Dim);
  if constexpr (Dim == 2) {
    out.push_back(pose.roll);
  } else {
    const auto& q = pose.attitude.coeffs();
    out.insert(out.end(), q.data(), q.data() + 4);
  }
  return out;
}

template <int Dim>
motion::Pose<Dim> pose_of(const std::vector<double>& v) {
  motion::Pose<Dim> pose;
  for (int a = 0; a < Dim; ++a) pose.cog[a] = v.at(static_cast<std::size_t>(a));
  if constexpr (Dim == 2) {
    pose.roll = v.at(2);
  } else {
    for (int a = 0; a < 4; ++a) pose.attitude.coeffs()[a] = v.at(static_cast<std::size_t>(3 + a));
  }
  return pose;
}

template <int Dim>
std::vector<double> numbers(const motion::DofVector<Dim>& v) {
  return {v.data(), v.data() + v.size()};
}
template <int Dim>
motion::DofVector<Dim> dof_vector(const std::vector<double>& v) {
  motion::DofVector<Dim> out;
  for (int i = 0; i < out.size(); ++i) out[i] = v.at(static_cast<std::size_t>(i));
  return out;
}

json to_json(const MappingReport& m) {
  return {{"method", m.method}, {"cpu_s", m.cpu_s}, {"vof_min", m.vof_min}, {"vof_max", m.vof_max},
          {"water_before", m.water_before}, {"water_after", m.water_after},
          {"divergence_before", m.divergence_before}, {"divergence_after", m.divergence_after},
          {"kept_cells", m.kept_cells}, {"new_cells", m.new_cells}, {"fall_backs", m.fall_backs}};
}
MappingReport mapping_of(const json& j) {
  return {j.at("method"), j.at("cpu_s"), j.at("vof_min"), j.at("vof_max"), j.at("water_before"),
          j.at("water_after"), j.at("divergence_before"), j.at("divergence_after"), j.at("kept_cells"),
          j.at("new_cells"), j.at("fall_backs")};
}

}  // namespace

template <int Dim>
std::vector<std::string> CascadeRun<Dim>::checkpoints() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(options_.folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file() && name.starts_with(prefix) && name.ends_with(".ck")) found.push_back(entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

template <int Dim>
void CascadeRun<Dim>::prune_checkpoints() const {
  const auto found = checkpoints();
  for (std::size_t i = 2; i < found.size(); ++i) {
    if (stage_ended_in(found[i])) continue;
    std::error_code ignored;
    fs::remove(found[i], ignored);
  }
}

template <int Dim>
void CascadeRun<Dim>::discard_checkpoints() const {
  for (const std::string& path : checkpoints()) {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
}

template <int Dim>
void CascadeRun<Dim>::write_checkpoint() {
  const auto& s = *simulation_;
  simulation_->clock().charge("output");
  const auto began = Clock::now();
  io::CheckpointWriter writer;
  json meta;
  meta["code_version"] = code_version();
  meta["sequence"] = sequence_;
  meta["initial_water"] = initial_water_;
  meta["next_sample"] = next_sample_;
  meta["next_snapshot"] = next_snapshot_;
  meta["time"] = s.time();
  meta["step"] = s.steps();
  meta["dt"] = s.dt();
  meta["next_dt"] = s.next_dt();
  meta["exchanged"] = s.exchanged();
  meta["released"] = s.body().released;
  meta["cells"] = s.forest().n_cells();
  json owed = json::array();
  for (const auto& [space, volume] : s.reservoirs()) owed.push_back({space, volume});
  meta["reservoirs"] = owed;
  json y_plus = json::array();
  for (const auto& [space, r] : s.y_plus())
    y_plus.push_back({space, r.smallest, r.largest, r.weighted, r.weight});
  meta["y_plus"] = y_plus;
  const StageResult so_far = result();
  meta["stage"] = {{"index", stage_.index}, {"start_time", stage_.start_time}, {"start_step", stage_.start_step},
                   {"wall_s", so_far.wall_s}, {"phases", so_far.phases}, {"iterations", stage_.iterations},
                   {"max_iterations", stage_.max_iterations}, {"has_mapping", stage_.has_mapping},
                   {"finished", stage_.finished}, {"mapping", to_json(stage_.mapping)}};
  writer.add("meta", meta.dump());
  writer.add("pose", numbers<Dim>(s.body().pose));
  writer.add("half_pose", numbers<Dim>(s.body().half_pose));
  writer.add("twist", numbers<Dim>(s.body().twist));
  writer.add("old_twist", numbers<Dim>(s.body().old_twist));
  writer.add("flow_monitor", flow_monitor_.save());
  writer.add("motion_monitor", motion_monitor_.save());
  writer.add("vof", io::pack<Dim>(s.forest(), s.state().vof));
  writer.add("p", io::pack<Dim>(s.forest(), s.state().p));
  if (s.state().turbulent()) {
    writer.add("tke", io::pack<Dim>(s.forest(), s.state().tke));
    writer.add("epsilon", io::pack<Dim>(s.forest(), s.state().epsilon));
  }
  for (int axis = 0; axis < Dim; ++axis) {
    writer.add(fmt::format("u{}", axis), io::pack<Dim>(s.forest(), s.state().u, axis));
    writer.add(fmt::format("w{}", axis), io::pack<Dim>(s.forest(), s.state().w, axis));
  }
  // A stage's end sorts after the same sample inside the stage.
  const std::string path = fmt::format("{}/{}{:010d}{}.ck", options_.folder, prefix, sequence_,
                                       stage_.finished ? fmt::format("e{}", stage_.index) : "a");
  writer.write(path, options_.case_digest);
  last_checkpoint_ = Clock::now();
  observer_.on_checkpoint(path, sequence_, std::chrono::duration<double>(last_checkpoint_ - began).count());
  prune_checkpoints();
  simulation_->clock().charge("checkpoint");
}

namespace {

/// Out of the way of new ones, which would otherwise be pruned as the older ones.
void set_aside(const std::string& path) {
  std::error_code ignored;
  fs::rename(path, path + ".rejected", ignored);
}

}  // namespace

template <int Dim>
bool CascadeRun<Dim>::resume() {
  for (const std::string& path : checkpoints()) {
    const auto reject = [&](const std::string& why) {
      set_aside(path);
      observer_.on_event("checkpoint_rejected", why);
      context_.log->warn("checkpoint rejected: {}", why);
    };
    try {
      restore(path);
      observer_.on_event("resumed", fmt::format("went on from {} at t = {:.4f} s, sample {}",
                                                fs::path(path).filename().string(), simulation_->time(), sequence_));
      return true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::data_loss) throw;
      reject(error.what());
    } catch (const json::exception& error) {
      reject(error.what());
    }
  }
  simulation_.reset();
  sequence_ = 0;
  next_sample_ = 0;
  return false;
}

template <int Dim>
void CascadeRun<Dim>::restore(const std::string& path) {
  const io::CheckpointReader reader(path, options_.case_digest);
  const json meta = json::parse(reader.text("meta"));
  const json& stage = meta.at("stage");
  const int index = stage.at("index");
  if (index < 0 || index >= static_cast<int>(case_.stages.size()))
    fail(ErrorCode::data_loss, "checkpoint {} is of stage {}, the case has {}", path, index, case_.stages.size());
  auto forest = make_forest(*model_, case_.stages[static_cast<std::size_t>(index)].mesh, context_.threads);
  flow::FlowState<Dim> state(*forest);
  io::unpack<Dim>(*forest, reader.values("vof"), state.vof);
  io::unpack<Dim>(*forest, reader.values("p"), state.p);
  if (model_->turbulence.model != flow::TurbulenceSpec::Model::none) {
    state.tke = flow::CellField<double, Dim>(*forest);
    state.epsilon = flow::CellField<double, Dim>(*forest);
    io::unpack<Dim>(*forest, reader.values("tke"), state.tke);
    io::unpack<Dim>(*forest, reader.values("epsilon"), state.epsilon);
  }
  for (int axis = 0; axis < Dim; ++axis) {
    io::unpack<Dim>(*forest, reader.values(fmt::format("u{}", axis)), axis, state.u);
    io::unpack<Dim>(*forest, reader.values(fmt::format("w{}", axis)), axis, state.w);
  }
  BodyState<Dim> body;
  body.pose = pose_of<Dim>(reader.values("pose"));
  body.half_pose = pose_of<Dim>(reader.values("half_pose"));
  body.twist = dof_vector<Dim>(reader.values("twist"));
  body.old_twist = dof_vector<Dim>(reader.values("old_twist"));
  body.released = meta.at("released");
  flow_monitor_ = CycleMonitor::load(reader.values("flow_monitor"));
  motion_monitor_ = CycleMonitor::load(reader.values("motion_monitor"));
  std::map<int, double> reservoirs;
  for (const json& entry : meta.at("reservoirs")) reservoirs[entry.at(0)] = entry.at(1);
  make_simulation(std::move(forest), index);
  simulation_->restore(std::move(state), body, meta.at("time"), meta.at("step"), meta.at("dt"), meta.at("next_dt"),
                       meta.at("exchanged"), reservoirs);
  std::map<int, flow::YPlusRange> y_plus;
  for (const json& r : meta.value("y_plus", json::array())) y_plus[r.at(0)] = {r.at(1), r.at(2), r.at(3), r.at(4)};
  simulation_->set_y_plus(y_plus);
  sequence_ = meta.at("sequence");
  initial_water_ = meta.at("initial_water");
  next_sample_ = meta.at("next_sample");
  next_snapshot_ = meta.at("next_snapshot");
  stage_ = {};
  stage_.index = index;
  stage_.start_time = stage.at("start_time");
  stage_.start_step = stage.at("start_step");
  stage_.wall_s = stage.at("wall_s");
  stage_.phases = stage.at("phases").get<PhaseTimes>();
  stage_.iterations = stage.at("iterations");
  stage_.max_iterations = stage.at("max_iterations");
  stage_.has_mapping = stage.at("has_mapping");
  stage_.finished = stage.at("finished");
  stage_.mapping = mapping_of(stage.at("mapping"));
  stage_begun_ = Clock::now();
  if (!stage_.finished) observer_.on_stage_started(info());
}

#define SEAWAY_INSTANTIATE(D)                                          \
  template std::vector<std::string> CascadeRun<D>::checkpoints() const; \
  template void CascadeRun<D>::prune_checkpoints() const;               \
  template void CascadeRun<D>::discard_checkpoints() const;             \
  template void CascadeRun<D>::write_checkpoint();                      \
  template bool CascadeRun<D>::resume();                                \
  template void CascadeRun<D>::restore(const std::string&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::sim
