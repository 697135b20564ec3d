#include "core/io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "core/base/error.hpp"

namespace seaway::io {
namespace {

class Checkpoint : public testing::Test {
 protected:
  Checkpoint() : path_(std::filesystem::temp_directory_path() / ("seaway_checkpoint_" + std::to_string(::getpid()))) {
    CheckpointWriter writer;
    writer.add("meta", "{\"t\": 1}");
    writer.add("vof", values_);
    writer.write(path_, "digest");
  }
  ~Checkpoint() override { std::filesystem::remove(path_); }
  std::string read() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string path_;
  std::vector<double> values_{0.1, -2.5e300, 1.0 / 3.0};
};

TEST_F(Checkpoint, GivesBackWhatWasWrittenToTheBit) {
  const CheckpointReader reader(path_, "digest");
  EXPECT_EQ(reader.text("meta"), "{\"t\": 1}");
  EXPECT_EQ(reader.values("vof"), values_);
  EXPECT_THROW((void)reader.values("p"), Error);
}

TEST_F(Checkpoint, OfAnotherCaseIsRefused) { EXPECT_THROW(CheckpointReader(path_, "other"), Error); }

TEST_F(Checkpoint, AnyFlippedBitIsFound) {
  const std::string good = read();
  std::mt19937 rng(11);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bad = good;
    bad[rng() % bad.size()] ^= static_cast<char>(1 << rng() % 8);
    write(bad);
    EXPECT_THROW(CheckpointReader(path_, "digest"), Error);
  }
}

TEST_F(Checkpoint, AnyTruncationIsFound) {
  const std::string good = read();
  for (std::size_t size = 0; size < good.size(); ++size) {
    write(good.substr(0, size));
    EXPECT_THROW(CheckpointReader(path_, "digest"), Error);
  }
}

}  // namespace
}  // namespace seaway::io
