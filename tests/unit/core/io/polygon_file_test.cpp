#include "core/io/polygon_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/base/error.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::io {
namespace {

PolygonMesh pyramid() {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 2}};
  mesh.polygons = {{3, 2, 1, 0}, {0, 1, 4}};
  mesh.values["height"] = {0, 0, 0, 0, 2};
  return mesh;
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Values of an appended array, found by its name and offset in the head of the file.
template <class T>
std::vector<T> array(const std::string& file, const std::string& name) {
  const std::size_t element = file.find("Name=\"" + name + "\"");
  const std::size_t offset = std::stoul(file.substr(file.find("offset=\"", element) + 8));
  const char* data = file.data() + file.find("encoding=\"raw\">_") + 16 + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, data, sizeof bytes);
  std::vector<T> out(bytes / sizeof(T));
  std::memcpy(out.data(), data + sizeof bytes, bytes);
  return out;
}

TEST(PolygonFile, HoldsPointsCornersAndValues) {
  const seaway::testing::TempFolder folder;
  const std::string path = folder.path() + "/p.vtp";
  write_vtp(pyramid(), path);
  const std::string file = content(path);
  EXPECT_NE(file.find("NumberOfPoints=\"5\""), std::string::npos);
  EXPECT_NE(file.find("NumberOfPolys=\"2\""), std::string::npos);
  const auto points = array<float>(file, "points");
  ASSERT_EQ(points.size(), 15U);
  EXPECT_EQ(points[14], 2.0F);
  EXPECT_EQ(array<std::int64_t>(file, "connectivity"), (std::vector<std::int64_t>{3, 2, 1, 0, 0, 1, 4}));
  EXPECT_EQ(array<std::int64_t>(file, "offsets"), (std::vector<std::int64_t>{4, 7}));
  EXPECT_EQ(array<float>(file, "height"), (std::vector<float>{0, 0, 0, 0, 2}));
}

TEST(PolygonFile, RefusesCornersThatDoNotExist) {
  PolygonMesh mesh = pyramid();
  mesh.polygons.push_back({0, 1, 5});
  const seaway::testing::TempFolder folder;
  EXPECT_THROW(write_vtp(mesh, folder.path() + "/p.vtp"), Error);
}

}  // namespace
}  // namespace seaway::io
