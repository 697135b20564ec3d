// Leaf values back into fields; apart from the file format, which knows no mesh.
#include <algorithm>

#include "core/base/error.hpp"
#include "core/io/checkpoint.hpp"

namespace seaway::io {
namespace {

template <int Dim, class Target>
void spread(const field::Forest<Dim>& forest, const std::vector<double>& values, std::size_t n, Target&& target) {
  if (values.size() != n * forest.leaves().size())
    fail(ErrorCode::data_loss, "a checkpoint's field has {} values, the mesh wants {}", values.size(),
         n * forest.leaves().size());
  std::size_t at = 0;
  for (const int b : forest.leaves()) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(at), n, target(b));
    at += n;
  }
}

}  // namespace

template <int Dim>
void unpack(const field::Forest<Dim>& forest, const std::vector<double>& values,
            field::CellField<double, Dim>& f) {
  spread<Dim>(forest, values, static_cast<std::size_t>(field::BlockShape<Dim>::cells),
              [&](int b) { return f.block(b); });
}

template <int Dim>
void unpack(const field::Forest<Dim>& forest, const std::vector<double>& values, int axis,
            field::FaceField<double, Dim>& f) {
  spread<Dim>(forest, values, static_cast<std::size_t>(field::BlockShape<Dim>::faces),
              [&](int b) { return f.block(axis, b); });
}

template void unpack<2>(const field::Forest<2>&, const std::vector<double>&, field::CellField<double, 2>&);
template void unpack<3>(const field::Forest<3>&, const std::vector<double>&, field::CellField<double, 3>&);
template void unpack<2>(const field::Forest<2>&, const std::vector<double>&, int, field::FaceField<double, 2>&);
template void unpack<3>(const field::Forest<3>&, const std::vector<double>&, int, field::FaceField<double, 3>&);

}  // namespace seaway::io
