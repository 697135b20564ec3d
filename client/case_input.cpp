// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/case_input.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace seaway::client {

namespace {

/// Reads what a field names, beside the case file. Once, if several fields name it.
void add_file(const std::string& path, const std::string& field, const std::string& name, CaseInput& in) {
  if (name.empty()) return;
  for (const v1::CaseFile& known : in.files)
    if (known.name() == name) return;
  const auto place = std::filesystem::path(path).parent_path() / name;
  std::ifstream stream(place, std::ios::binary);
  if (!stream)
    throw yaml::InputError(path, {{in.lines.find(field), field, place.string() + " cannot be opened", "the name is relative to the case file"}});
  v1::CaseFile& file = *in.files.Add();
  file.set_name(name);
  file.mutable_content()->assign(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

CaseInput read_case(const std::string& path) {
  CaseInput in;
  in.lines = yaml::read_file(path, in.message);
  const v1::Hull& hull = in.message.hull();
  add_file(path, "hull.stl.file", hull.stl().file(), in);
  add_file(path, "hull.offsets_hull.file", hull.offsets_hull().file(), in);
  add_file(path, "hull.offsets_section.file", hull.offsets_section().file(), in);
  add_file(path, "wave.time_series.file", in.message.wave().time_series().file(), in);
  return in;
}

void rethrow_with_lines(const RpcError& error, const CaseInput& in, const std::string& file) {
  if (error.violations().empty()) throw error;
  std::vector<yaml::Problem> problems;
  for (const auto& [field, text] : error.violations()) problems.push_back({in.lines.find(field), field, text, ""});
  throw yaml::InputError(file, std::move(problems));
}

}  // namespace seaway::client
