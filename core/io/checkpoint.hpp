// Checkpoint files: named byte sections behind a header, each with its CRC-32, and one over the whole file.
// A file is written aside, synced and renamed, so a name always holds a complete file; a damaged one is
// recognised before anything of it is used.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/field/field.hpp"

namespace seaway::io {

class CheckpointWriter {
 public:
  void add(const std::string& name, std::string bytes) { sections_[name] = std::move(bytes); }
  void add(const std::string& name, std::span<const double> values);
  /// Throws Error(resource_exhausted) when the disk is full, Error(unavailable) for other failures.
  void write(const std::string& path, const std::string& case_digest) const;

 private:
  std::map<std::string, std::string> sections_;
};

class CheckpointReader {
 public:
  /// Throws Error(data_loss) naming what is wrong: truncated, changed, of another format version or case.
  CheckpointReader(const std::string& path, const std::string& case_digest);
  const std::string& text(const std::string& name) const;
  std::vector<double> values(const std::string& name) const;

 private:
  std::string path_;
  std::map<std::string, std::string> sections_;
};

/// Leaf values of a field in leaf order, and back. The forest must be the same.
template <int Dim>
std::vector<double> pack(const field::Forest<Dim>& forest, const field::CellField<double, Dim>& f) {
  constexpr auto n = static_cast<std::size_t>(field::BlockShape<Dim>::cells);
  std::vector<double> out;
  out.reserve(n * forest.leaves().size());
  for (const int b : forest.leaves()) out.insert(out.end(), f.block(b), f.block(b) + n);
  return out;
}
template <int Dim>
std::vector<double> pack(const field::Forest<Dim>& forest, const field::FaceField<double, Dim>& f, int axis) {
  constexpr auto n = static_cast<std::size_t>(field::BlockShape<Dim>::faces);
  std::vector<double> out;
  out.reserve(n * forest.leaves().size());
  for (const int b : forest.leaves()) out.insert(out.end(), f.block(axis, b), f.block(axis, b) + n);
  return out;
}
/// Throws Error(data_loss) when the count does not fit the forest.
template <int Dim>
void unpack(const field::Forest<Dim>& forest, const std::vector<double>& values, field::CellField<double, Dim>& f);
template <int Dim>
void unpack(const field::Forest<Dim>& forest, const std::vector<double>& values, int axis,
            field::FaceField<double, Dim>& f);

}  // namespace seaway::io
