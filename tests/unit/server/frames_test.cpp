// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/frames.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::jobs {
namespace {

std::vector<std::string> read_all(FrameReader& reader) {
  std::vector<std::string> out;
  while (auto content = reader.next()) out.push_back(std::move(*content));
  return out;
}

TEST(Frames, ComeBackHoweverTheBytesArrive) {
  const std::vector<std::string> sent{"first", "", std::string(100'000, 'x'), std::string("\0\1\2", 3)};
  std::string bytes;
  for (const std::string& content : sent) bytes += make_frame(content);
  for (const std::size_t piece : {1, 7, 4096, 1'000'000}) {
    FrameReader reader;
    std::vector<std::string> got;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      reader.feed(std::string_view(bytes).substr(at, piece));
      for (std::string& content : read_all(reader)) got.push_back(std::move(content));
    }
    EXPECT_EQ(got, sent);
    EXPECT_EQ(reader.left_over(), 0u);
  }
}

TEST(Frames, ATornEndIsNoRecord) {
  const std::string whole = make_frame("whole"), torn = make_frame("torn");
  for (std::size_t n = 0; n < torn.size(); ++n) {
    FrameReader reader;
    reader.feed(whole + torn.substr(0, n));
    EXPECT_EQ(read_all(reader), std::vector<std::string>{"whole"});
    EXPECT_EQ(reader.left_over(), n);
  }
}

TEST(Frames, NoFlippedBitBecomesARecord) {
  const std::string good = make_frame("some samples of a run, to be kept to the bit");
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    FrameReader reader;
    reader.feed(bad);
    try {
      EXPECT_TRUE(read_all(reader).empty()) << bit;  // a larger length: it waits for the rest
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::data_loss);
    }
  }
}

}  // namespace
}  // namespace seaway::jobs
