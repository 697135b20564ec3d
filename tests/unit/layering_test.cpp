// Who may include what (docs/architecture.md). One target a folder makes most of it true at link
// time; headers of templates and of system libraries are visible to every target, so the sources
// are read here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Folders = std::set<std::string>;

/// Folders of the core from the bottom up, and which others each may use. All may use base.
const std::map<std::string, Folders> core_rules = {
    {"core/base", {}},
    {"core/analysis", {}},
    {"core/mesh", {}},
    {"core/waves", {}},
    {"core/hull", {}},
    {"core/motion", {}},
    {"core/field", {"core/mesh"}},
    {"core/linear", {"core/mesh", "core/field"}},
    {"core/flow",
     {"core/mesh", "core/waves", "core/hull", "core/motion", "core/field", "core/linear"}},
    {"core/transfer",
     {"core/mesh", "core/waves", "core/hull", "core/motion", "core/field", "core/linear",
      "core/flow"}},
    {"core/io",
     {"core/mesh", "core/waves", "core/hull", "core/motion", "core/field", "core/linear",
      "core/flow"}},
    {"core/sim",
     {"core/mesh", "core/waves", "core/hull", "core/motion", "core/field", "core/linear",
      "core/flow", "core/transfer", "core/io"}},
};

/// Parts of the service and of the client. "core" stands for all of it.
const std::map<std::string, Folders> outer_rules = {
    {"proto", {}},
    {"server/store", {"proto", "core/base"}},
    {"server/convert", {"proto", "core"}},
    {"server/metrics", {"core/base"}},
    {"server/reports", {"proto", "core", "server/convert"}},
    {"server/jobs", {"proto", "core", "server/store", "server/convert", "server/metrics"}},
    {"server/rpc",
     {"proto", "core", "server/store", "server/convert", "server/jobs", "server/metrics",
      "server/reports"}},
    {"server/http", {"core/base"}},
    {"server",
     {"proto", "core", "server/store", "server/convert", "server/jobs", "server/reports",
      "server/rpc", "server/http", "server/metrics"}},
    {"client", {"proto"}},
};

/// Headers that only some folders may see; a folder stands for all below it.
struct Restricted {
  std::regex header;
  const char* what;
  Folders allowed;
};
const std::vector<Restricted>& restricted_headers() {
  static const std::vector<Restricted> list = {
      {std::regex(R"(^(p4est|p8est|p6est|sc)(_\w+)?\.h$|^mpi\.h$|^omp\.h$)"),
       "p4est, MPI and OpenMP",
       {"core/mesh"}},
      {std::regex(R"(^sqlite3\w*\.h$)"), "SQLite", {"server/store"}},
      {std::regex(R"(^prometheus/)"), "prometheus-cpp", {"server/metrics"}},
      {std::regex(R"(^httplib\.h$)"), "cpp-httplib", {"server/http"}},
      {std::regex(R"(^(grpc|grpcpp|grpc\+\+)/|\.grpc\.pb\.h$)"), "gRPC", {"server/rpc", "client"}},
      {std::regex(R"(^yaml-cpp/)"), "yaml-cpp", {"proto"}},
      {std::regex(R"(^google/protobuf/|\.pb\.h$)"),
       "protobuf messages",
       {"proto", "server", "client"}},
      {std::regex(R"(^CLI/)"), "CLI11", {"server", "client"}},
      {std::regex(R"(^CGAL/)"), "CGAL", {"core/hull"}},
      {std::regex(R"(^(H5\w*|hdf5\w*)\.h$)"), "HDF5", {}},
  };
  return list;
}

bool is_in(const std::string& folder, const std::string& allowed) {
  return folder == allowed || folder.rfind(allowed + "/", 0) == 0;
}

bool is_in_any(const std::string& folder, const Folders& allowed) {
  for (const std::string& one : allowed) {
    if (is_in(folder, one)) return true;
  }
  return false;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The entry of a rule table that a folder belongs to: the longest one that contains it.
std::string layer_of(const std::string& folder) {
  std::string best;
  for (const auto* table : {&core_rules, &outer_rules}) {
    for (const auto& [name, unused] : *table) {
      if (is_in(folder, name) && name.size() > best.size()) best = name;
    }
  }
  return best;
}

std::string complaint_about_own(const std::string& layer, const std::string& target) {
  const std::string target_folder = folder_of(target);
  if (is_in(target_folder, "tests")) return "product code may not use tests";
  if (layer_of(target_folder) == layer) return {};
  const bool core = core_rules.count(layer) > 0;
  Folders allowed = core ? core_rules.at(layer) : outer_rules.at(layer);
  if (core) allowed.insert("core/base");
  if (is_in_any(target_folder, allowed)) return {};
  std::string list;
  for (const std::string& one : allowed) list += (list.empty() ? "" : ", ") + one;
  return layer + " may use only " + (list.empty() ? "itself" : list);
}

/// One message "file:line: ..." for each forbidden include of a source text at `path` (from the
/// root).
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  static const std::regex include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  static const std::regex omp(R"(^\s*#\s*pragma\s+omp\b)");
  static const std::regex own(R"(^(core|server|client|proto|tests)/)");
  static const std::regex generated(R"(\.pb\.h$)");
  std::vector<std::string> out;
  const std::string folder = folder_of(path), layer = layer_of(folder);
  const auto report = [&](int line, const std::string& what, const std::string& why) {
    out.push_back(path + ":" + std::to_string(line) + ": " + what + ": " + why);
  };
  if (layer.empty()) {
    report(1, folder,
           "this folder is in no layer; add it to docs/architecture.md and to this test");
    return out;
  }
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, omp) && !is_in(folder, "core/mesh")) {
      report(number, "#pragma omp", "threads belong to core/mesh alone (for_each_block)");
    }
    if (!std::regex_search(line, match, include)) continue;
    const std::string header = match[2];
    const std::string what = "#include " + header;
    for (const Restricted& rule : restricted_headers()) {
      if (std::regex_search(header, rule.header) && !is_in_any(folder, rule.allowed)) {
        std::string list;
        for (const std::string& one : rule.allowed) list += (list.empty() ? "" : ", ") + one;
        report(number, what,
               std::string(rule.what) + " only in " + (list.empty() ? "no folder" : list));
      }
    }
    if (std::regex_search(header, own)) {
      const std::string why = complaint_about_own(layer, header);
      if (!why.empty()) report(number, what, why);
    } else if (match[1] == "\"" && !std::regex_search(header, generated)) {
      report(number, what, "write includes from the root of the source");
    }
  }
  return out;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Layering, SourcesFollowTheRules) {
  const std::filesystem::path root = SEAWAY_SOURCE_DIR;
  int n_files = 0;
  for (const char* top : {"core", "server", "client", "proto"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp" && extension != ".h") continue;
      ++n_files;
      const std::string path = std::filesystem::relative(entry.path(), root).generic_string();
      for (const std::string& violation : violations(path, read(entry.path()))) {
        ADD_FAILURE() << violation;
      }
    }
  }
  EXPECT_GT(n_files, 20) << "the sources were not found in " << root;
}

TEST(Layering, FindsUpwardIncludeWithFileAndLine) {
  EXPECT_THAT(violations("core/mesh/forest.cpp", "// forest\n#include \"core/flow/vof.hpp\"\n"),
              ElementsAre(HasSubstr("core/mesh/forest.cpp:2: #include core/flow/vof.hpp: core/mesh "
                                    "may use only core/base")));
}

TEST(Layering, FindsEachKindOfViolation) {
  const auto count = [](const char* path, const char* line) {
    return static_cast<int>(violations(path, line).size());
  };
  EXPECT_EQ(count("core/waves/a.cpp", "#include \"core/hull/hull.hpp\""), 1);
  EXPECT_EQ(count("core/flow/a.cpp", "#include \"core/transfer/map.hpp\""), 1);
  EXPECT_EQ(count("core/sim/a.cpp", "#include \"server/jobs/queue.hpp\""), 1);
  EXPECT_EQ(count("core/sim/a.cpp", "#include \"seaway/v1/case.pb.h\""), 1);
  EXPECT_EQ(count("core/field/a.cpp", "#include <p4est.h>"), 1);
  EXPECT_EQ(count("core/field/a.cpp", "#include <p8est_extended.h>"), 1);
  EXPECT_EQ(count("core/flow/a.cpp", "  #  include <omp.h>"), 1);
  EXPECT_EQ(count("core/flow/a.cpp", "#pragma omp parallel for"), 1);
  EXPECT_EQ(count("server/run_main.cpp", "#include <mpi.h>"), 1);
  EXPECT_EQ(count("server/jobs/a.cpp", "#include <sqlite3.h>"), 1);
  EXPECT_EQ(count("server/jobs/a.cpp", "#include <grpcpp/grpcpp.h>"), 1);
  EXPECT_EQ(count("server/jobs/a.cpp", "#include \"seaway/v1/job_service.grpc.pb.h\""), 1);
  EXPECT_EQ(count("server/store/a.cpp", "#include \"server/jobs/queue.hpp\""), 1);
  EXPECT_EQ(count("server/store/a.cpp", "#include \"core/sim/case.hpp\""), 1);
  EXPECT_EQ(count("server/convert/a.cpp", "#include <yaml-cpp/yaml.h>"), 1);
  EXPECT_EQ(count("client/a.cpp", "#include \"server/convert/case.hpp\""), 1);
  EXPECT_EQ(count("client/commands/a.cpp", "#include \"core/base/error.hpp\""), 1);
  EXPECT_EQ(count("server/a.cpp", "#include \"client/job_client.hpp\""), 1);
  EXPECT_EQ(count("proto/yaml.cpp", "#include \"core/sim/case.hpp\""), 1);
  EXPECT_EQ(count("core/io/a.cpp", "#include <hdf5.h>"), 1);
  EXPECT_EQ(count("core/io/a.cpp", "#include \"tests/support/tank.hpp\""), 1);
  EXPECT_EQ(count("core/io/a.cpp", "#include \"checkpoint.hpp\""), 1);
  EXPECT_EQ(count("core/extras/a.cpp", "int main() {}"), 1);
}

TEST(Layering, AcceptsWhatIsAllowed) {
  const auto check = [](const char* path, const char* line) {
    EXPECT_THAT(violations(path, line), IsEmpty());
  };
  check("core/mesh/forest.cpp", "#include <p4est.h>\n#include <mpi.h>\n#pragma omp parallel\n");
  check("core/mesh/forest.cpp",
        "#include \"core/mesh/block.hpp\"\n#include \"core/base/error.hpp\"");
  check("core/sim/a.cpp",
        "#include \"core/flow/vof.hpp\"\n#include <Eigen/Core>\n#include <vector>");
  check("server/store/sqlite.cpp", "#include <sqlite3.h>\n#include \"core/base/error.hpp\"");
  check("server/rpc/server.cpp", "#include <grpcpp/server.h>\n#include \"server/jobs/queue.hpp\"");
  check("server/main.cpp", "#include <CLI/CLI.hpp>\n#include \"server/rpc/server.hpp\"");
  check("client/commands/plot.cpp",
        "#include \"client/job_client.hpp\"\n#include \"seaway/v1/job_service.grpc.pb.h\"");
  check("proto/yaml.cpp", "#include <yaml-cpp/parser.h>\n#include <google/protobuf/message.h>");
}

}  // namespace
