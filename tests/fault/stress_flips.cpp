// SPDX-License-Identifier: GPL-3.0-or-later
// bit_flips: a checkpoint of the solver with something wrong in it is never taken for a good one.
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "core/base/error.hpp"
#include "core/io/checkpoint.hpp"
#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

namespace fs = std::filesystem;

/// A checkpoint that seaway-run has written in the middle of the case.
std::string some_checkpoint(const Settings& s, const std::string& folder) {
  testing::Process run({s.seaway_run, s.case_file, "-o", folder + "/run", "-q", "--checkpoint-interval", "0.05",
                        "--threads", std::to_string(s.threads)});
  std::string found;
  while (found.empty()) {
    const bool ended = run.wait_for(std::chrono::milliseconds(20)) >= 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder + "/run", error))
      if (entry.path().extension() == ".ck") found = entry.path();
    if (ended && found.empty()) throw std::runtime_error("bit_flips: the run ended without a checkpoint");
  }
  const std::string bytes = testing::read_text(found);  // complete: it has been renamed to this name
  run.signal(SIGKILL);
  run.wait();
  return bytes;
}

/// The digest of the case as it stands in the file.
std::string digest_of(const std::string& bytes) {
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return bytes.substr(20, size);
}

bool is_accepted(const std::string& path, const std::string& bytes, const std::string& digest) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  try {
    const io::CheckpointReader reader(path, digest);
    return true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::data_loss) throw;
    return false;
  }
}

}  // namespace

std::vector<Line> bit_flips(const Settings& s) {
  const testing::TempFolder folder;
  std::fprintf(stderr, "bit_flips: seed %u\n", s.seed);
  const std::string good = some_checkpoint(s, folder.path()), digest = digest_of(good);
  const std::string path = folder / "flipped.ck";
  if (!is_accepted(path, good, digest)) throw std::runtime_error("bit_flips: the good checkpoint is refused");
  std::mt19937_64 random(s.seed);
  int wrong = 0;
  for (int i = 0; i < s.flips; ++i) {
    std::string bad = good;
    // Half of them in the first kilobyte, where lengths and names are; now and then several, or a cut.
    const int n = i % 10 == 9 ? 1 + static_cast<int>(random() % 8) : 1;
    for (int k = 0; k < n; ++k) {
      const std::size_t byte = random() % (i % 2 == 0 ? std::min<std::size_t>(1024, bad.size()) : bad.size());
      bad[byte] = static_cast<char>(bad[byte] ^ (1 << (random() % 8)));
    }
    if (i % 50 == 49) bad.resize(random() % bad.size());
    if (bad != good && is_accepted(path, bad, digest)) ++wrong;
  }
  std::fprintf(stderr, "bit_flips: %d damages of a checkpoint of %zu bytes\n", s.flips, good.size());
  return {{"bit_flips", "wrong_resumes", static_cast<double>(wrong), "1", 0, 0}};
}

}  // namespace seaway::stress
