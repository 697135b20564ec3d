// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the first inputs of each target, made by the code that the targets read with: seaway_fuzz_seeds FOLDER
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/io/checkpoint.hpp"
#include "proto/yaml.hpp"
#include "seaway/v1/job_service.pb.h"
#include "seaway/worker/attempt.pb.h"
#include "server/jobs/frames.hpp"
#include "server/rpc/messages.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace fs = std::filesystem;
using namespace seaway;

namespace {

void put(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A tetrahedron with normals that point outwards.
std::string tetrahedron(bool binary) {
  constexpr float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string out(80, ' ');
  const std::uint32_t n = 4;
  out.append(reinterpret_cast<const char*>(&n), sizeof n);
  std::string text = "solid t\n";
  for (const auto& face : faces) {
    out.append(12, '\0');
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      out.append(reinterpret_cast<const char*>(p[corner]), sizeof p[corner]);
      text += "vertex";
      for (const float x : p[corner]) text += " " + std::to_string(x);
      text += "\n";
    }
    out.append(2, '\0');
    text += "endloop\nendfacet\n";
  }
  return binary ? out : text + "endsolid t\n";
}

/// A decay in the letters of a name, options of both reports, and a case, as sweeps.cpp reads them.
std::string reports_seed(const v1::Case& message) {
  v1::DecayOptions decay;
  for (int i = 0; i < 400; ++i)
    decay.mutable_channel()->push_back(static_cast<char>(64 + 60 * std::exp(-0.01 * i) * std::cos(0.4 * i)));
  decay.set_smallest_peak(0.05);
  v1::RaoOptions rao;
  rao.set_period_count(2);
  return fuzz::make_part(decay.SerializeAsString()) + fuzz::make_part(rao.SerializeAsString()) + message.SerializeAsString();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const fs::path to = argv[1];
  const std::string small = read_text(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml");
  put(to / "case_yaml/small", small);
  for (const auto& entry : fs::directory_iterator(SEAWAY_SOURCE_DIR "/client/examples"))
    if (entry.path().extension() == ".yaml") put(to / "case_yaml" / entry.path().stem(), read_text(entry.path().string()));
  v1::CreateJobRequest submit;
  yaml::read(small, "small.yaml", *submit.mutable_case_());
  submit.set_request_id("00000000-0000-4000-8000-000000000001");
  (*submit.mutable_labels())["ship"] = "a";
  submit.add_files()->set_name("hull.csv");
  put(to / "requests/submit", std::string(1, '\0') + submit.SerializeAsString());
  v1::UpdateJobRequest update;
  update.mutable_job()->set_name("jobs/abc");
  update.mutable_update_mask()->add_paths("labels");
  put(to / "requests/update", '\1' + update.SerializeAsString());
  v1::CreateSweepRequest sweep;
  sweep.set_request_id(submit.request_id());
  sweep.add_cases()->set_name("small");
  *sweep.mutable_cases(0)->mutable_case_() = submit.case_();
  for (const double period : {1.2, 1.4}) sweep.add_periods_s(period);
  sweep.add_heights_m(0.03);
  put(to / "sweeps/sweep", std::string(1, '\0') + sweep.SerializeAsString());
  sweep.set_validate_only(true);
  put(to / "sweeps/check", std::string(1, '\0') + sweep.SerializeAsString());
  put(to / "sweeps/reports", '\1' + reports_seed(submit.case_()));
  worker::Record record;
  record.mutable_sample()->set_sequence(1);
  record.mutable_sample()->add_values(0.5);
  put(to / "requests/records", '\2' + jobs::make_frame(record.SerializeAsString()) + jobs::make_frame("x"));
  v1::ListJobsRequest list;
  list.add_states(v1::Job::STATE_HELD);
  (*list.mutable_labels())["ship"] = "a";
  put(to / "filter/list", list.SerializeAsString());
  put(to / "page_token/all", std::string(1, '\0') + rpc::make_page_token(17, {}));
  store::ListQuery held;
  held.states = {store::State::held};
  put(to / "page_token/held", std::string(1, 1 << 2) + rpc::make_page_token(123456, held));
  put(to / "stl/binary", std::string(1, '\0') + tetrahedron(true));
  put(to / "stl/ascii", std::string(1, '\0') + tetrahedron(false));
  io::CheckpointWriter checkpoint;
  checkpoint.add("meta", std::string("{\"sequence\": 1}"));
  checkpoint.add("pose", std::vector<double>{0, 1, 2});
  fs::create_directories(to / "checkpoint");
  checkpoint.write((to / "checkpoint/small").string(), "digest");
  return 0;
}
