#include "core/hull/stl_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

class StlFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string("stl_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "hull.stl").string(); }

  void write_binary(const Surface& s, std::uint32_t announced, const char* title = "seaway") {
    std::ofstream out(path(), std::ios::binary);
    char head[80] = {};
    std::strncpy(head, title, sizeof head - 1);
    out.write(head, sizeof head);
    out.write(reinterpret_cast<const char*>(&announced), 4);
    for (const auto& t : s.triangles) {
      float record[12] = {};
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < 3; ++a) record[3 + 3 * i + a] = static_cast<float>(s.vertices[t[i]][a]);
      out.write(reinterpret_cast<const char*>(record), sizeof record);
      out.write("\0\0", 2);
    }
  }
  void write_binary(const Surface& s) {
    write_binary(s, static_cast<std::uint32_t>(s.triangles.size()));
  }
  void write_text(const Surface& s) {
    std::ofstream out(path());
    out << "solid hull\n";
    for (const auto& t : s.triangles) {
      out << "facet normal 0 0 0\n outer loop\n";
      for (const int v : t) out << "  vertex " << s.vertices[v].transpose() << "\n";
      out << " endloop\nendfacet\n";
    }
    out << "endsolid hull\n";
  }
  /// The message that reading gives; empty if it succeeds.
  std::string problem(double unit = 1) const {
    try {
      read_stl(path(), unit);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  static bool says(const std::string& message, const char* part) {
    return message.find(part) != std::string::npos;
  }
  std::filesystem::path folder_;
};

TEST_F(StlFile, BinaryAndTextGiveTheHullBack) {
  const Surface box = box_surface(2000, 400, 300);
  write_binary(box);
  const Surface a = read_stl(path(), 0.001);
  EXPECT_EQ(a.vertices.size(), 8u);
  EXPECT_NEAR(enclosed_volume(a), 0.24, 1e-9);
  write_text(box);
  const Surface b = read_stl(path(), 0.001);
  EXPECT_EQ(b.triangles.size(), 12u);
  EXPECT_NEAR(enclosed_volume(b), 0.24, 1e-12);
  write_binary(box, 12, "solid but binary");
  EXPECT_NEAR(enclosed_volume(read_stl(path(), 0.001)), 0.24, 1e-9);
}

TEST_F(StlFile, EachFaultHasItsMessage) {
  const Surface box = box_surface(2, 0.4, 0.3);
  EXPECT_THROW(read_stl(path(), 1), Error);  // no file
  write_binary(box);
  EXPECT_TRUE(says(problem(0), "unit"));
  EXPECT_TRUE(says(problem(std::nan("")), "unit"));
  EXPECT_TRUE(says(problem(1000), "Check the unit"));
  EXPECT_EQ(problem(), "");
  write_binary(flipped(box));
  EXPECT_TRUE(says(problem(), "inwards"));
  Surface s = box;
  s.triangles.pop_back();
  write_binary(s);
  EXPECT_TRUE(says(problem(), "not closed"));
  s = box;
  std::swap(s.triangles[0][0], s.triangles[0][1]);
  write_binary(s);
  EXPECT_TRUE(says(problem(), "different sides"));
  s = box;
  s.vertices[0].x() = std::nan("");
  write_binary(s);
  EXPECT_TRUE(says(problem(), "not a finite number"));
  write_binary(joined(box, transformed(box, 1, Eigen::Matrix3d::Identity(), Vec3(0.1, 0.1, 0.1))));
  EXPECT_TRUE(says(problem(), "cross"));
  write_binary({}, 0);
  EXPECT_TRUE(says(problem(), "no triangles"));
}

TEST_F(StlFile, HeadThatAnnouncesTooMuchCostsNoMemory) {
  write_binary({}, 0xffffffffu);
  EXPECT_TRUE(says(problem(), "announces 4294967295 triangles, but the file holds only 0"));
}

TEST_F(StlFile, EmptyShortAndForeignFiles) {
  std::ofstream(path()).close();
  EXPECT_TRUE(says(problem(), "empty"));
  std::ofstream(path()) << "hello";
  EXPECT_TRUE(says(problem(), "too few"));
  std::ofstream(path()) << "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n";
  EXPECT_TRUE(says(problem(), "is not a number"));
  std::ofstream(path()) << "solid x\nendsolid\n";
  EXPECT_TRUE(says(problem(), "no triangles"));
}

}  // namespace
}  // namespace seaway::hull
