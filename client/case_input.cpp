// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/case_input.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace seaway::client {

CaseInput read_case(const std::string& path) {
  CaseInput in;
  in.lines = yaml::read_file(path, in.message);
  const v1::Hull& hull = in.message.hull();
  const bool whole = hull.has_offsets_hull();
  const std::string& table = hull.has_stl() ? hull.stl().file()
                             : whole        ? hull.offsets_hull().file()
                                            : hull.offsets_section().file();
  if (table.empty()) return in;
  const auto place = std::filesystem::path(path).parent_path() / table;
  std::ifstream stream(place, std::ios::binary);
  if (!stream) {
    const std::string field = hull.has_stl() ? "hull.stl.file" : whole ? "hull.offsets_hull.file" : "hull.offsets_section.file";
    throw yaml::InputError(path, {{in.lines.find(field), field, place.string() + " cannot be opened", "the name is relative to the case file"}});
  }
  v1::CaseFile& file = *in.files.Add();
  file.set_name(table);
  file.mutable_content()->assign(std::istreambuf_iterator<char>(stream), {});
  return in;
}

void rethrow_with_lines(const RpcError& error, const CaseInput& in, const std::string& file) {
  if (error.violations().empty()) throw error;
  std::vector<yaml::Problem> problems;
  for (const auto& [field, text] : error.violations()) problems.push_back({in.lines.find(field), field, text, ""});
  throw yaml::InputError(file, std::move(problems));
}

}  // namespace seaway::client
